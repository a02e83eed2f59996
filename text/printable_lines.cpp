// SPDX-License-Identifier: Apache-2.0
#include "text/printable_lines.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "text/printable.h"

namespace kerf::text {

namespace {

/// Returns the JSON form of an escape of `printable`: `\x9b`, `\u202e` or `\U000e0001`.
std::string json_escape(const std::string& escape) {
    const unsigned long code = std::strtoul(escape.c_str() + 2, nullptr, 16);
    std::array<char, 48> text{};
    if (code < 0x10000) {
        std::snprintf(text.data(), text.size(), "\\u%04lx", code);
    } else {
        const unsigned long above = code - 0x10000;
        std::snprintf(text.data(), text.size(), "\\u%04lx\\u%04lx", 0xd800 + (above >> 10), 0xdc00 + (above & 0x3ff));
    }
    return text.data();
}

std::size_t bytes_of_first(std::string_view text) noexcept {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t bytes = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    return std::min(bytes, text.size());
}

}  // namespace

std::string printable_lines(std::string_view text) {
    std::string safe;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\n\t"), text.size());
        std::string_view line = text.substr(0, end);
        const bool has_return = end < text.size() && text[end] == '\n' && line.ends_with('\r');
        if (has_return) line.remove_suffix(1);
        safe += printable(line) + (has_return ? "\r" : "");
        if (end < text.size()) safe += text[end];
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return safe;
}

std::string printable_json(std::string_view json) {
    std::string safe;
    safe.reserve(json.size());
    while (!json.empty()) {
        const std::string_view character = json.substr(0, bytes_of_first(json));
        json.remove_prefix(character.size());
        const bool is_ascii = character.size() == 1 && static_cast<unsigned char>(character.front()) < 0x7f;
        const std::string shown = is_ascii ? std::string(character) : printable(character);
        safe += shown == character ? shown : json_escape(shown);
    }
    return safe;
}

}  // namespace kerf::text
