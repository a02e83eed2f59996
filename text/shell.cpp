// SPDX-License-Identifier: Apache-2.0
#include "text/shell.h"

#include "text/printable.h"

namespace kerf::text {
namespace {

constexpr std::string_view plain_characters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+=:,@%";

/// Returns whether a character means itself in `$'…'`.
bool is_plain_in_quotes(char c) noexcept { return c >= ' ' && c <= '~' && c != '\'' && c != '\\'; }

}  // namespace

std::string shell_quoted(std::string_view word) {
    if (!word.empty() && word.find_first_not_of(plain_characters) == std::string_view::npos) return std::string(word);
    std::string quoted = "'";
    if (printable(word) == word) {
        for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        return quoted + "'";
    }
    constexpr std::string_view digits = "0123456789abcdef";
    for (const char c : word) {
        if (is_plain_in_quotes(c)) {
            quoted += c;
            continue;
        }
        const unsigned byte = static_cast<unsigned char>(c);
        quoted += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
    return "$" + quoted + "'";
}

std::string shell_path(std::string_view path) {
    return shell_quoted(path.starts_with('-') ? "./" + std::string(path) : std::string(path));
}

}  // namespace kerf::text
