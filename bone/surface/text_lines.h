// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

namespace kerf::bone {

/// Words of a text, line by line, in any locale.
class TextLines {
public:
    explicit TextLines(std::string_view text) : rest_(text) {}

    /// Moves to the next line. Returns false after the last. Lines end with LF, CR LF or CR.
    bool next() {
        if (rest_.empty()) return false;
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        line_ = whole_ = rest_.substr(0, end);
        const bool is_pair = rest_.substr(end, 2) == "\r\n";
        rest_.remove_prefix(std::min(end + (is_pair ? 2 : 1), rest_.size()));
        ++number_;
        return true;
    }
    /// Returns the next word of the line; empty after the last.
    std::string_view word() {
        const std::size_t begin = std::min(line_.find_first_not_of(" \t\r\f\v"), line_.size());
        line_.remove_prefix(begin);
        const std::string_view found = line_.substr(0, std::min(line_.find_first_of(" \t\r\f\v"), line_.size()));
        line_.remove_prefix(found.size());
        return found;
    }
    /// Returns the next word, on this line or a later one.
    std::string_view word_on_any_line() {
        for (;;) {
            const std::string_view found = word();
            if (!found.empty() || !next()) return found;
        }
    }
    /// Skips the remaining words of the line.
    void drop_line() noexcept { line_ = {}; }
    /// Returns whether no word remains on the line.
    [[nodiscard]] bool is_at_end() const noexcept {
        return line_.find_first_not_of(" \t\r\f\v") == std::string_view::npos;
    }
    [[nodiscard]] std::string_view whole_line() const noexcept { return whole_; }
    [[nodiscard]] std::size_t number() const noexcept { return number_; }  ///< of the line, from 1
    [[nodiscard]] std::string_view rest_of_text() const noexcept { return rest_; }

private:
    std::string_view rest_, line_, whole_;
    std::size_t number_ = 0;
};

/// Returns the number of a word, or nothing if it is not a number. Underflow gives zero, overflow infinity.
[[nodiscard]] inline std::optional<double> number_in(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    if (error == std::errc::result_out_of_range)
        return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos ? 0.0 : HUGE_VAL;
    if (error != std::errc{}) return std::nullopt;
    return value;
}

}  // namespace kerf::bone
