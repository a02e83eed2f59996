// SPDX-License-Identifier: Apache-2.0
#include "text/look_alike.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace kerf::text {
namespace {

/// Returns the first code point of checked UTF-8. A byte out of sequence is a character of its own.
std::uint32_t decoded(std::string_view text, std::size_t& size) noexcept {
    const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
    const std::uint32_t first = byte(0);
    size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 1;
    if (size == 1 || size > text.size()) {
        size = 1;
        return first;
    }
    std::uint32_t code = first & (0xFFu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) code = code << 6 | (byte(i) & 0x3Fu);
    return code;
}

struct Entry {
    std::uint32_t code;
    const char* name;
    const char* ascii;
};

constexpr std::array entries{
    Entry{0x00A0, "no-break space", " "},
    Entry{0x00AB, "quotation mark", "\""},
    Entry{0x00AD, "soft hyphen", ""},
    Entry{0x00B4, "acute accent", "'"},
    Entry{0x00B7, "middle dot", " "},
    Entry{0x00BB, "quotation mark", "\""},
    Entry{0x00D7, "multiplication sign", "x"},
    Entry{0x03BF, "Greek letter", "o"},
    Entry{0x0430, "Cyrillic letter", "a"},
    Entry{0x0435, "Cyrillic letter", "e"},
    Entry{0x043A, "Cyrillic letter", "k"},
    Entry{0x043C, "Cyrillic letter", "m"},
    Entry{0x043E, "Cyrillic letter", "o"},
    Entry{0x0440, "Cyrillic letter", "p"},
    Entry{0x0441, "Cyrillic letter", "c"},
    Entry{0x0443, "Cyrillic letter", "y"},
    Entry{0x0445, "Cyrillic letter", "x"},
    Entry{0x0455, "Cyrillic letter", "s"},
    Entry{0x0456, "Cyrillic letter", "i"},
    Entry{0x0458, "Cyrillic letter", "j"},
    Entry{0x066B, "Arabic decimal separator", "."},
    Entry{0x066C, "Arabic thousands separator", " "},
    Entry{0x1680, "typographic space", " "},
    Entry{0x200B, "zero width space", ""},
    Entry{0x200C, "zero width non-joiner", ""},
    Entry{0x200D, "zero width joiner", ""},
    Entry{0x2010, "hyphen", "-"},
    Entry{0x2011, "no-break hyphen", "-"},
    Entry{0x2012, "figure dash", "-"},
    Entry{0x2013, "en dash", "-"},
    Entry{0x2014, "em dash", "-"},
    Entry{0x2018, "quotation mark", "'"},
    Entry{0x2019, "quotation mark", "'"},
    Entry{0x201A, "quotation mark", "'"},
    Entry{0x201B, "quotation mark", "'"},
    Entry{0x201C, "quotation mark", "\""},
    Entry{0x201D, "quotation mark", "\""},
    Entry{0x201E, "quotation mark", "\""},
    Entry{0x201F, "quotation mark", "\""},
    Entry{0x2024, "one dot leader", "."},
    Entry{0x202F, "narrow no-break space", " "},
    Entry{0x2039, "quotation mark", "'"},
    Entry{0x203A, "quotation mark", "'"},
    Entry{0x2043, "hyphen bullet", "-"},
    Entry{0x2044, "fraction slash", "/"},
    Entry{0x205F, "typographic space", " "},
    Entry{0x2060, "word joiner", ""},
    Entry{0x2212, "minus sign", "-"},
    Entry{0x2215, "division slash", "/"},
    Entry{0x2236, "ratio sign", ":"},
    Entry{0x22C5, "dot operator", " "},
    Entry{0x3000, "ideographic space", " "},
    Entry{0x3001, "ideographic comma", ","},
    Entry{0x3002, "ideographic full stop", "."},
    Entry{0xFE63, "small hyphen-minus", "-"},
    Entry{0xFEFF, "byte order mark", ""},
};

struct Digits {
    std::uint32_t zero;
    const char* name;
};
constexpr std::array digits{Digits{0x0660, "Arabic digit"}, Digits{0x06F0, "Persian digit"},
                            Digits{0x0966, "Devanagari digit"}, Digits{0x1D7CE, "mathematical digit"}};

std::optional<LookAlike> look_alike(std::uint32_t code) {
    if (code < 0x80) return std::nullopt;
    for (const Entry& entry : entries)
        if (entry.code == code) return LookAlike{code, entry.name, entry.ascii};
    if (code >= 0x2000 && code <= 0x200A) return LookAlike{code, "typographic space", " "};
    if (code >= 0xFF01 && code <= 0xFF5E)
        return LookAlike{code, "full-width character", std::string(1, static_cast<char>(code - 0xFF01 + '!'))};
    for (const Digits& some : digits)
        if (code >= some.zero && code < some.zero + 10)
            return LookAlike{code, some.name, std::string(1, static_cast<char>(code - some.zero + '0'))};
    return std::nullopt;
}

template <class Visit>  // visit(code, begin, size) returns true to continue
void for_each_character(std::string_view text, const Visit& visit) {
    for (std::size_t at = 0, size = 1; at < text.size(); at += size) {
        const std::uint32_t code = decoded(text.substr(at), size);
        if (!visit(code, at, size)) return;
    }
}

const char* name_of_control(std::uint32_t code) noexcept {
    if (code == '\t' || code == '\n' || code == '\r') return nullptr;
    if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return code == 0x85 ? "next line" : "control character";
    if (code == 0x2028) return "line separator";
    if (code == 0x2029) return "paragraph separator";
    if ((code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069)) return "direction of writing";
    if (code == 0xFFFE || code == 0xFFFF) return "no character";
    return nullptr;
}

}  // namespace

std::string code_point_text(std::uint32_t code) {
    char text[16];
    std::snprintf(text, sizeof text, "U+%04X", static_cast<unsigned>(code));
    return text;
}

std::optional<LookAlike> find_look_alike(std::string_view text) {
    std::optional<LookAlike> found;
    for_each_character(text, [&](std::uint32_t code, std::size_t at, std::size_t size) {
        found = look_alike(code);
        if (!found) return true;
        found->at = at;
        found->size = size;
        return false;
    });
    return found;
}

std::string straightened(std::string_view text) {
    std::string straight;
    for_each_character(text, [&](std::uint32_t code, std::size_t at, std::size_t size) {
        const std::optional<LookAlike> found = look_alike(code);
        straight += found ? found->ascii : std::string(text.substr(at, size));
        return true;
    });
    return straight;
}

std::optional<LookAlike> find_control(std::string_view text) {
    std::optional<LookAlike> found;
    for_each_character(text, [&](std::uint32_t code, std::size_t at, std::size_t size) {
        const char* name = name_of_control(code);
        if (name != nullptr) found = LookAlike{code, name, "", at, size};
        return name == nullptr;
    });
    return found;
}

std::string about(const LookAlike& found) {
    std::string character;  // as UTF-8
    if (found.code < 0x800) {
        character += static_cast<char>(0xC0u | found.code >> 6);
    } else if (found.code < 0x10000) {
        character += static_cast<char>(0xE0u | found.code >> 12);
        character += static_cast<char>(0x80u | (found.code >> 6 & 0x3Fu));
    } else {
        character += static_cast<char>(0xF0u | found.code >> 18);
        character += static_cast<char>(0x80u | (found.code >> 12 & 0x3Fu));
        character += static_cast<char>(0x80u | (found.code >> 6 & 0x3Fu));
    }
    character += static_cast<char>(0x80u | (found.code & 0x3Fu));
    const std::string code = code_point_text(found.code);
    const bool is_blank = found.ascii == " " || found.ascii.empty();
    if (is_blank && found.code != 0x00B7 && found.code != 0x22C5)
        return "it holds " + code + " (" + found.name + "), " +
               (found.ascii.empty() ? "which shows nothing" : "not a plain space");
    return "`" + character + "` is " + code + " (" + found.name + "), not `" + found.ascii + "`";
}

}  // namespace kerf::text
