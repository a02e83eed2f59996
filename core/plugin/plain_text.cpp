// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/plain_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace kerf {

namespace {

struct Character {
    std::size_t size = 0;  ///< bytes; 0: not a UTF-8 character
    std::uint32_t code = 0;
};

/// Returns the first character of `text`, which is not empty.
Character front_of(std::string_view text) noexcept {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80) return {1, byte(0)};
    const std::size_t size = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
    if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < size) return {};
    std::uint32_t code = byte(0) & (0x7fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xc0u) != 0x80u) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::uint32_t minimum[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < minimum[size] || code > 0x10ffff || is_surrogate) return {};
    return {size, code};
}

bool is_control(std::uint32_t code) noexcept {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200e && code <= 0x200f) ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

bool is_utf8(std::string_view text) noexcept {
    while (!text.empty()) {
        const Character c = front_of(text);
        if (c.size == 0) return false;
        text.remove_prefix(c.size);
    }
    return true;
}

bool is_plain(std::string_view text) noexcept {
    while (!text.empty()) {
        const Character c = front_of(text);
        if (c.size == 0 || is_control(c.code)) return false;
        text.remove_prefix(c.size);
    }
    return true;
}

std::string plain(std::string_view text) {
    constexpr char digits[] = "0123456789abcdef";
    std::string shown;
    while (!text.empty()) {
        const Character c = front_of(text);
        const bool is_shown = c.size > 0 && !is_control(c.code);
        const std::size_t size = std::max<std::size_t>(c.size, 1);
        for (const char byte : text.substr(0, size)) {
            const auto value = static_cast<unsigned char>(byte);
            if (is_shown)
                shown += byte;
            else
                shown.append("\\x") += {digits[value >> 4], digits[value & 15]};
        }
        text.remove_prefix(size);
    }
    return shown;
}

std::string quoted_plain(std::string_view text) {
    constexpr std::size_t maximum = 60;
    std::string_view kept = text.substr(0, maximum);
    while (kept.size() < text.size() && !kept.empty() &&
           (static_cast<unsigned char>(text[kept.size()]) & 0xc0u) == 0x80u)
        kept.remove_suffix(1);
    return "`" + plain(kept) + (kept.size() < text.size() ? "…`" : "`");
}

}  // namespace kerf
