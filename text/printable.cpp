// SPDX-License-Identifier: Apache-2.0
#include "text/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace kerf::text {
namespace {

/// One character of a text: its code point and its number of bytes. A byte that is not UTF-8 is a character of its own.
struct Character {
    std::uint32_t code = 0;
    std::size_t size = 1;
    bool is_utf8 = true;
};

Character first_of(std::string_view text) noexcept {
    const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
    const std::uint32_t first = byte(0);
    if (first < 0x80) return {first, 1, true};
    const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || size > text.size()) return {first, 1, false};
    std::uint32_t code = first & (0xFFu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0u) != 0x80u) return {first, 1, false};
        code = code << 6 | (byte(i) & 0x3Fu);
    }
    constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < smallest[size] || code > 0x10FFFF || is_surrogate) return {first, 1, false};
    return {code, size, true};
}

/// Returns whether the code is a control character, or in Unicode a format character, a line separator or a code point
/// without a character.
bool is_hidden(std::uint32_t code) noexcept {
    constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 15> ranges{{{0x00, 0x1F},
                                                                              {0x7F, 0x9F},
                                                                              {0xAD, 0xAD},
                                                                              {0x061C, 0x061C},
                                                                              {0x115F, 0x1160},
                                                                              {0x180E, 0x180E},
                                                                              {0x200B, 0x200F},
                                                                              {0x2028, 0x202E},
                                                                              {0x2060, 0x206F},
                                                                              {0x3164, 0x3164},
                                                                              {0xE000, 0xF8FF},
                                                                              {0xFE00, 0xFE0F},
                                                                              {0xFEFF, 0xFEFF},
                                                                              {0xFFF0, 0xFFFB},
                                                                              {0xE0000, 0x10FFFF}}};
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const auto& range) { return code >= range.first && code <= range.second; });
}

std::string escaped(std::uint32_t code) {
    const std::size_t digits = code < 0x100 ? 2 : code < 0x10000 ? 4 : 8;
    std::string text = digits == 2 ? "\\x" : digits == 4 ? "\\u" : "\\U";
    for (std::size_t i = digits; i-- > 0;) text += "0123456789abcdef"[code >> (4 * i) & 0xFu];
    return text;
}

template <class Take>  // take(Character, bytes)
void for_each_character(std::string_view text, const Take& take) {
    while (!text.empty()) {
        const Character one = first_of(text);
        if (!take(one, text.substr(0, one.size))) return;
        text.remove_prefix(one.size);
    }
}

void append_printable(std::string& result, const Character& one, std::string_view bytes) {
    if (!one.is_utf8 || is_hidden(one.code))
        result += escaped(one.code);
    else
        result += bytes;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string result;
    for_each_character(text, [&](const Character& one, std::string_view bytes) {
        append_printable(result, one, bytes);
        return true;
    });
    return result;
}

std::string excerpt(std::string_view text, std::size_t max_size) {
    std::string result;
    std::size_t count = 0;
    for_each_character(text, [&](const Character& one, std::string_view bytes) {
        if (++count <= max_size) append_printable(result, one, bytes);
        return true;
    });
    if (count <= max_size) return result;
    return result + "… (" + std::to_string(count - max_size) +
           (count - max_size == 1 ? " more character)" : " more characters)");
}

std::string yaml_quoted(std::string_view text) {
    std::string result = "\"";
    for_each_character(text, [&](const Character& one, std::string_view bytes) {
        if (one.code == '"' || one.code == '\\') result += '\\';
        append_printable(result, one, bytes);
        return true;
    });
    return result + "\"";
}

std::string yaml_word(std::string_view text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto is_part = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
    // Words that YAML or its readers take for a truth value or null.
    constexpr std::array<std::string_view, 8> reserved{"true", "false", "yes", "no", "on", "off", "null", "y"};
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const bool is_plain = !text.empty() && is_letter(text.front()) && std::all_of(text.begin(), text.end(), is_part) &&
                          lower != "n" && std::find(reserved.begin(), reserved.end(), lower) == reserved.end();
    return is_plain ? std::string(text) : yaml_quoted(text);
}

}  // namespace kerf::text
