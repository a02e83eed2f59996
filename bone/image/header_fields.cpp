// SPDX-License-Identifier: Apache-2.0
#include "bone/image/header_fields.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

#include "bone/image/header_checks.h"
#include "text/printable.h"

namespace kerf::bone::header {
namespace {

template <class Number>
std::vector<Number> numbers_of(std::string_view text, const std::string& field) {
    std::vector<Number> numbers;
    for (const std::string_view word : words_of(text)) {
        std::string_view digits = word;
        if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
        Number value{};
        const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (end.ec != std::errc{} || end.ptr != digits.data() + digits.size())
            refuse("E0622", "`" + field + "` in the header is \"" + text::excerpt(text) + "\", must be numbers.",
                   "Export the image again.");
        numbers.push_back(value);
    }
    return numbers;
}

}  // namespace

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blank);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

std::vector<std::string_view> words_of(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

void add(Fields& fields, std::string_view name, std::string_view value) {
    if (!fields.emplace(lower(trimmed(name)), std::string(trimmed(value))).second)
        refuse("E0622", "the header has `" + text::excerpt(trimmed(name)) + "` twice.", "Export the image again.");
}

const std::string* find(const Fields& fields, std::initializer_list<const char*> names) {
    const std::string* found = nullptr;
    for (const char* name : names)
        if (const auto at = fields.find(name); at != fields.end()) {
            if (found) refuse("E0622", "the header has two names for `" + at->first + "`.", "Remove one.");
            found = &at->second;
        }
    return found;
}

const std::string& need(const Fields& fields, std::initializer_list<const char*> names) {
    if (const std::string* found = find(fields, names)) return *found;
    refuse("E0622", "the header has no `" + std::string(*names.begin()) + "`.", "Export the image again.");
}

std::vector<double> decimals_of(std::string_view text, const std::string& field) {
    return numbers_of<double>(text, field);
}
std::vector<long long> wholes_of(std::string_view text, const std::string& field) {
    return numbers_of<long long>(text, field);
}
long long whole_of(std::string_view text, const std::string& field) {
    const auto numbers = wholes_of(text, field);
    if (numbers.size() != 1)
        refuse("E0622", "`" + field + "` in the header is \"" + text::excerpt(text) + "\", must be one whole number.",
               "Export the image again.");
    return numbers.front();
}

std::vector<std::string> quoted_words_of(std::string_view text, const std::string& field) {
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = text.find_first_not_of(" \t", at)) != std::string_view::npos;) {
        const bool is_quoted = text[at] == '"';
        const std::size_t begin = is_quoted ? at + 1 : at;
        std::size_t end = text.find_first_of(is_quoted ? "\"" : " \t", begin);
        if (end == std::string_view::npos && is_quoted)
            refuse("E0622", "`" + field + "` has a quotation mark that is not closed.", "Export the image again.");
        end = std::min(end, text.size());
        words.emplace_back(trimmed(text.substr(begin, end - begin)));
        at = std::min(end + 1, text.size());
    }
    return words;
}

ImageFile::Number named_number(const std::string& type) {
    using Number = ImageFile::Number;
    static const std::map<std::string, Number> known{{"signed char", Number::int8},
                                                     {"int8", Number::int8},
                                                     {"int8_t", Number::int8},
                                                     {"uchar", Number::uint8},
                                                     {"unsigned char", Number::uint8},
                                                     {"uint8", Number::uint8},
                                                     {"uint8_t", Number::uint8},
                                                     {"short", Number::int16},
                                                     {"short int", Number::int16},
                                                     {"signed short", Number::int16},
                                                     {"signed short int", Number::int16},
                                                     {"int16", Number::int16},
                                                     {"int16_t", Number::int16},
                                                     {"ushort", Number::uint16},
                                                     {"unsigned short", Number::uint16},
                                                     {"unsigned short int", Number::uint16},
                                                     {"uint16", Number::uint16},
                                                     {"uint16_t", Number::uint16},
                                                     {"int", Number::int32},
                                                     {"signed int", Number::int32},
                                                     {"int32", Number::int32},
                                                     {"int32_t", Number::int32},
                                                     {"uint", Number::uint32},
                                                     {"unsigned int", Number::uint32},
                                                     {"uint32", Number::uint32},
                                                     {"uint32_t", Number::uint32},
                                                     {"longlong", Number::int64},
                                                     {"long long", Number::int64},
                                                     {"long long int", Number::int64},
                                                     {"signed long long", Number::int64},
                                                     {"signed long long int", Number::int64},
                                                     {"int64", Number::int64},
                                                     {"int64_t", Number::int64},
                                                     {"ulonglong", Number::uint64},
                                                     {"unsigned long long", Number::uint64},
                                                     {"unsigned long long int", Number::uint64},
                                                     {"uint64", Number::uint64},
                                                     {"uint64_t", Number::uint64},
                                                     {"float", Number::float32},
                                                     {"double", Number::float64},
                                                     {"met_char", Number::int8},
                                                     {"met_uchar", Number::uint8},
                                                     {"met_short", Number::int16},
                                                     {"met_ushort", Number::uint16},
                                                     {"met_int", Number::int32},
                                                     {"met_uint", Number::uint32},
                                                     {"met_long_long", Number::int64},
                                                     {"met_ulong_long", Number::uint64},
                                                     {"met_float", Number::float32},
                                                     {"met_double", Number::float64}};
    const std::string name = lower(type);
    const auto found = known.find(name);
    if (found != known.end()) return found->second;
    if (name == "met_long" || name == "met_ulong")
        refuse("E0625", "the voxel type `" + text::excerpt(type) + "` has 4 bytes in some programs and 8 in others.",
               "Export the image as MET_INT or MET_SHORT.");
    refuse("E0625",
           "the header names voxel type `" + text::excerpt(type) +
               "`, must be one whole number or floating point number per voxel.",
           "Export the image as 16-bit integers.");
}

}  // namespace kerf::bone::header
