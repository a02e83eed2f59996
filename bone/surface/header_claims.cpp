// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/header_claims.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "text/printable.h"

namespace kerf::bone {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

bool is_part_of_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Returns the next word behind `key =` and moves `at` behind it. Nothing if there is none.
std::optional<std::string> next_value(std::string_view text, const std::string& key, std::size_t& at) {
    const std::string folded = lower(text);
    while ((at = folded.find(key, at)) != std::string::npos) {
        const bool is_whole = at == 0 || !is_part_of_word(text[at - 1]);
        at += key.size();
        const std::size_t equals = std::min(text.find_first_not_of(" \t", at), text.size());
        if (!is_whole || equals == text.size() || text[equals] != '=') continue;
        const std::size_t begin = std::min(text.find_first_not_of(" \t", equals + 1), text.size());
        const auto* end =
            std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), is_part_of_word);
        at = static_cast<std::size_t>(end - text.begin());
        return std::string(text.substr(begin, at - begin));
    }
    return std::nullopt;
}

template <class Value>
bool keep(std::optional<Value>& kept, std::optional<Value> value, const std::string& claim, const char* allowed,
          SurfaceError& error) {
    if (value && (!kept || *kept == *value)) {
        kept = value;
        return true;
    }
    error = {"E0654",
             value ? "the header contradicts itself: it says " + claim + ", and another one elsewhere."
                   : "the header says " + claim + ", must be " + allowed + ".",
             "Export the surface again, or correct its header."};
    return false;
}

std::optional<double> metres_in(const std::string& unit) {
    static constexpr std::array<std::pair<std::string_view, double>, 12> known{{{"mm", 1e-3},
                                                                                {"millimeter", 1e-3},
                                                                                {"millimetre", 1e-3},
                                                                                {"cm", 1e-2},
                                                                                {"centimeter", 1e-2},
                                                                                {"centimetre", 1e-2},
                                                                                {"m", 1.0},
                                                                                {"meter", 1.0},
                                                                                {"metre", 1.0},
                                                                                {"um", 1e-6},
                                                                                {"micrometer", 1e-6},
                                                                                {"micrometre", 1e-6}}};
    std::string word = lower(unit);
    if (word.size() > 2 && word.ends_with('s')) word.pop_back();
    for (const auto& [name, metres] : known)
        if (word == name) return metres;
    return std::nullopt;
}

}  // namespace

bool read_claims(std::string_view text, SurfaceFile& file, SurfaceError& error) {
    std::size_t at = 0;
    while (const auto space = next_value(text, "space", at)) {
        const std::string word = lower(*space);
        const auto is_ras = word == "ras" ? std::optional(true) : word == "lps" ? std::optional(false) : std::nullopt;
        if (!keep(file.is_ras, is_ras, "SPACE=" + text::excerpt(*space, 20), "RAS or LPS", error)) return false;
    }
    for (const char* key : {"unit", "units"}) {
        at = 0;
        while (const auto unit = next_value(text, key, at))
            if (!keep(file.unit, metres_in(*unit), "UNITS=" + text::excerpt(*unit, 20), "mm, cm, m or um", error))
                return false;
    }
    return true;
}

std::optional<std::string_view> utf8_of(std::string_view text, SurfaceError& error) {
    if (text.starts_with("\xef\xbb\xbf")) return text.substr(3);
    if (!text.starts_with("\xff\xfe") && !text.starts_with("\xfe\xff")) return text;
    error = {"E0643", "the file is text in UTF-16, must be ASCII or UTF-8.", "Save it as UTF-8, or export it again."};
    return std::nullopt;
}

}  // namespace kerf::bone
