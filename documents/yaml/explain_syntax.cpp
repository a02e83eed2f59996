// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/explain_syntax.h"

#include <yaml-cpp/exceptions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <ranges>
#include <string_view>
#include <utility>
#include <vector>

#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The end of a text in quotation marks that begins at `at`; npos if there is none.
std::size_t end_of_quoted(std::string_view text, std::size_t at) {
    const char mark = text[at];
    for (std::size_t i = at + 1; i < text.size(); ++i) {
        if (mark == '"' && text[i] == '\\')
            ++i;
        else if (text[i] == mark && mark == '\'' && i + 1 < text.size() && text[i + 1] == mark)
            ++i;
        else if (text[i] == mark)
            return i;
    }
    return std::string_view::npos;
}

Unclosed unclosed_at(std::string_view text, std::size_t at) {
    const char closer = text[at] == '{' ? '}' : text[at] == '[' ? ']' : text[at];
    const std::size_t line_end = std::min(text.find('\n', at), text.size());
    return {at, closer, text.find_first_not_of(blanks, line_end) == std::string_view::npos};
}

}  // namespace

std::optional<Unclosed> find_unclosed_quote(std::string_view text, std::size_t at) {
    if (at >= text.size() || (text[at] != '"' && text[at] != '\'')) return std::nullopt;
    return end_of_quoted(text, at) == std::string_view::npos ? std::optional(unclosed_at(text, at)) : std::nullopt;
}

std::string about(const Unclosed& unclosed, char opener) {
    const std::string open = std::string("`") + opener + "`", close = std::string("`") + unclosed.closer + "`";
    return unclosed.is_last_line ? "This " + open + " is not closed before the file ends. Put " + close +
                                       " where its content ends. Is the file cut off?"
                                 : "This " + open + " is never closed. Put " + close + " where its content ends.";
}

std::optional<Unclosed> find_unclosed(std::string_view text) {
    std::vector<std::size_t> open;
    char before = '\n';  // the last that is not blank, or the line's beginning
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool is_start = std::string_view("\n[{,:-").find(before) != std::string_view::npos;
        if (c == '#' && (i == 0 || blanks.find(text[i - 1]) != std::string_view::npos)) {
            i = std::min(text.find('\n', i), text.size()) - 1;
            continue;
        }
        if ((c == '"' || c == '\'') && is_start) {
            const std::size_t end = end_of_quoted(text, i);
            if (end == std::string_view::npos) return unclosed_at(text, i);
            i = end;
        } else if ((c == '{' || c == '[') && (is_start || !open.empty())) {
            open.push_back(i);
        } else if ((c == '}' || c == ']') && !open.empty()) {
            const bool is_pair = (c == '}') == (text[open.back()] == '{');
            if (!is_pair) return unclosed_at(text, open.back());
            open.pop_back();
        }
        if (c == '\n' || blanks.find(c) == std::string_view::npos) before = c;
    }
    return open.empty() ? std::nullopt : std::optional(unclosed_at(text, open.back()));
}

std::optional<Unclosed> find_unclosed_for(const std::string& complaint, std::string_view text, std::size_t at) {
    namespace M = YAML::ErrorMsg;
    const bool is_about_an_end = std::ranges::any_of(
        std::array{M::END_OF_MAP_FLOW, M::END_OF_SEQ_FLOW, M::UNKNOWN_TOKEN, M::EOF_IN_SCALAR, M::FLOW_END},
        [&](const char* message) { return complaint == message; });
    if (is_about_an_end) return find_unclosed(text);
    if (complaint != M::BLOCK_ENTRY) return std::nullopt;
    // No list of lines begins within brackets: those of a line before are not closed.
    const std::optional<Unclosed> before = find_unclosed(text.substr(0, std::min(at, text.size())));
    return before && text.substr(before->at, at - before->at).find('\n') != std::string_view::npos
               ? std::optional(unclosed_at(text, before->at))
               : std::nullopt;
}

std::string NumberRow::text(std::string_view between) const {
    std::string joined;
    for (const std::string_view number : numbers) joined.append(joined.empty() ? "" : between).append(number);
    return joined;
}

NumberRow find_number_row(std::string_view text, std::size_t at) {
    constexpr std::size_t max_numbers = 8;
    NumberRow row;
    for (std::size_t begin = at; row.numbers.size() < max_numbers && begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(",}]\n", begin), text.size());
        std::string_view number = text.substr(begin, end - begin);
        while (number.ends_with(' ')) number.remove_suffix(1);
        const std::size_t sign = number.starts_with('-') ? 1 : 0;
        const bool is_number = number.size() > sign &&
                               std::string_view(".0123456789").find(number[sign]) != std::string_view::npos &&
                               number.find(':') == std::string_view::npos;
        if (!is_number) break;
        row.numbers.push_back(number);
        if (row.numbers.size() > 1) row.size = begin + number.size() - at;
        const std::size_t next = std::min(text.find_first_not_of(' ', end + 1), text.size());
        if (end == text.size() || text[end] != ',' || next == end + 1) break;  // `3,2` is a decimal comma
        begin = next;
    }
    return row;
}

namespace {

std::size_t begin_of_line(std::string_view text, std::size_t at) {
    const std::size_t before = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
    return before == std::string_view::npos ? 0 : before + 1;
}

std::string_view line_at(std::string_view text, std::size_t begin) {
    return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
}

std::size_t indent_of(std::string_view line) { return std::min(line.find_first_not_of(blanks), line.size()); }

/// Where the content of a line begins, behind its indentation and the dashes of list items.
std::size_t content_of(std::string_view line) {
    std::size_t at = indent_of(line);
    while (line.substr(at).starts_with("- ")) at += 2 + indent_of(line.substr(at + 2));
    return at;
}

/// The beginning of the nearest line above that is neither empty nor a comment; npos if there is none.
std::size_t line_above(std::string_view text, std::size_t begin) {
    while (begin > 0) {
        begin = begin_of_line(text, begin - 1);
        const std::string_view line = line_at(text, begin);
        if (const std::size_t indent = indent_of(line); indent < line.size() && line[indent] != '#') return begin;
    }
    return std::string_view::npos;
}

/// A line without its comment and the blanks at its end.
std::string_view without_comment(std::string_view line) {
    line = line.substr(0, line.find(" #"));
    return line.substr(0, line.find_last_not_of(blanks) + 1);
}

bool has_key(std::string_view line) { return line.find(": ") != std::string_view::npos || line.ends_with(':'); }

std::string shown(std::string_view text) { return "`" + text::excerpt(text, 40) + "`"; }

/// The mistake in the line that begins at `line_begin`, if `found` is one of its content.
std::optional<SyntaxMistake> in_line(std::string_view text, std::size_t line_begin,
                                     std::optional<SyntaxMistake> (*find)(std::string_view)) {
    const std::string_view line = without_comment(line_at(text, line_begin));
    const bool is_of_dash = find == find_missing_dash_space;
    const std::size_t begin = is_of_dash ? indent_of(line) : content_of(line);
    std::optional<SyntaxMistake> found = find(line.substr(std::min(begin, line.size())));
    if (found) found->at = line_begin + begin;
    return found;
}

const char* meaning_of(const std::string& complaint) {
    namespace M = YAML::ErrorMsg;
    const std::array<std::pair<const char*, const char*>, 11> meanings{{
        {M::UNKNOWN_ANCHOR, "This alias has no anchor, and aliases are not allowed. Write the value itself."},
        {M::MAP_VALUE,
         "This `:` is where no key can be. Put text that holds `: ` into quotation marks, or indent the line like the "
         "keys beside it."},
        {M::MAP_KEY, "This key is where none can be. Indent the line like the keys beside it."},
        {M::BLOCK_ENTRY,
         "This `-` is where no list can begin. Put it on a line of its own, indented like its neighbours."},
        {M::END_OF_MAP, "This line is indented like none above it. Indent it like the keys that it belongs to."},
        {M::END_OF_SEQ, "This line is indented like none above it. Indent it like the items that it belongs to."},
        {M::UNKNOWN_TOKEN, "No value begins with this character. Put the text into quotation marks."},
        {M::END_OF_MAP_FLOW,
         "This cannot be between `{` and `}`. Put text that holds `: ` or `,` into quotation marks, and a `,` between "
         "entries."},
        {M::END_OF_SEQ_FLOW,
         "This cannot be between `[` and `]`. Put text that holds `: ` or `,` into quotation marks, and a `,` between "
         "items."},
        {M::FLOW_END, "This closes a `[` or `{` that was not opened. Remove it, or open it before."},
        {M::EOF_IN_SCALAR, "The file ends in the middle of a text in quotation marks. Close it."},
    }};
    for (const auto& [message, meaning] : meanings)
        if (complaint == message) return meaning;
    return nullptr;
}

/// What is wrong with the line of a complaint, or with the one above it that a parser read on with.
SyntaxMistake find_mistake(const std::string& complaint, std::string_view text, std::size_t at) {
    namespace M = YAML::ErrorMsg;
    const std::size_t begin = begin_of_line(text, at), above = line_above(text, begin);
    const std::string_view line = line_at(text, begin);
    if (line.substr(0, indent_of(line)).find('\t') != std::string_view::npos)
        return {at, 1, "A tab is at the beginning of the line. Indent with spaces."};
    const std::string_view before = line.substr(0, std::min(at - begin, line.size()));
    const bool is_second_colon = complaint == M::MAP_VALUE && before.find(": ") != std::string_view::npos;
    const bool is_flow = complaint == M::END_OF_MAP_FLOW || complaint == M::END_OF_SEQ_FLOW;
    if (!is_second_colon && !is_flow) {
        for (const std::size_t some : {above, begin})
            for (const auto find : {find_missing_space, find_missing_dash_space})
                if (some != std::string_view::npos)
                    if (auto found = in_line(text, some, find)) return *found;
    }
    if (complaint == M::END_OF_MAP &&
        (without_comment(before).ends_with('"') || without_comment(before).ends_with('\'')))
        return {at, 1, "Text follows a closing quotation mark. Put all of it into one pair of marks."};
    if (complaint == M::MAP_VALUE && !is_second_colon && above != std::string_view::npos) {
        const std::string_view upper = without_comment(line_at(text, above));
        const std::size_t upper_content = std::min(content_of(upper), upper.size());
        if (!has_key(upper) && content_of(line) <= upper_content)
            return {above + upper_content, upper.size() - upper_content,
                    "This line has no colon: got " + shown(upper.substr(upper_content)) +
                        ", expected `key: value`. Put a colon and a space behind the key."};
        if (content_of(line) > upper_content)
            return {begin + indent_of(line), 1,
                    "This line is indented deeper than the one above it, which has a value already. Indent it like "
                    "that line."};
    }
    if (const std::string_view content = without_comment(line); complaint == M::END_OF_MAP && !has_key(content)) {
        const std::size_t from = content_of(content);
        if (from < content.size() && content[from] != '-')
            return {begin + from, content.size() - from,
                    "This line has no colon: got " + shown(content.substr(from)) +
                        ", expected `key: value`. Put a colon and a space behind the key."};
    }
    const char* meaning = meaning_of(complaint);
    return {at, 1, meaning != nullptr ? std::string(meaning) : "This is not YAML: " + complaint + ". Correct it."};
}

}  // namespace

std::optional<SyntaxMistake> find_missing_space(std::string_view text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto is_part = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-'; };
    std::size_t colon = 0;
    while (colon < text.size() && is_part(text[colon])) ++colon;
    if (colon == 0 || !is_letter(text[0]) || colon + 1 >= text.size() || text[colon] != ':') return std::nullopt;
    const std::string_view value = text.substr(colon + 1);
    if (blanks.find(value[0]) != std::string_view::npos || value[0] == ':' || value.starts_with("//"))
        return std::nullopt;
    const std::string key(text.substr(0, colon));
    SyntaxMistake mistake{0, text.size(), "", ""};
    const std::optional<text::LookAlike> space = text::find_look_alike(value);
    if (space && space->at == 0 && space->ascii == " ") {
        mistake.message = "`" + key + ":` is followed by " + text::code_point_text(space->code) + " (" + space->name +
                          "), expected a plain space.";
        mistake.write = key + ": " + std::string(value.substr(space->size));
    } else {
        mistake.message = "A space is missing behind the colon: got " + shown(text) + ".";
        mistake.write = key + ": " + std::string(value);
    }
    if (mistake.write.size() > 80 || mistake.write.find('\n') != std::string::npos) {
        mistake.write.clear();
        mistake.message += " Put one there.";
    }
    return mistake;
}

std::optional<SyntaxMistake> find_missing_dash_space(std::string_view text) {
    const bool is_item = text.size() > 1 && text[0] == '-' && text[1] != '-' && text[1] != '.' &&
                         blanks.find(text[1]) == std::string_view::npos && !(text[1] >= '0' && text[1] <= '9');
    if (!is_item) return std::nullopt;
    SyntaxMistake mistake{0, text.size(), "A space is missing behind the dash: got " + shown(text) + ".",
                          "- " + std::string(text.substr(1))};
    if (mistake.write.size() > 80) {
        mistake.write.clear();
        mistake.message += " Put one there.";
    }
    return mistake;
}

SyntaxMistake explain_syntax(const std::string& complaint, std::string_view text, std::size_t at) {
    at = std::min(at, text.size());
    SyntaxMistake mistake = find_mistake(complaint, text, at);
    // What looks like a sign of YAML may be why.
    const std::string_view line = line_at(text, begin_of_line(text, mistake.at));
    const std::optional<text::LookAlike> look_alike = text::find_look_alike(without_comment(line));
    if (look_alike && mistake.write.empty()) {
        std::string named = about(*look_alike);
        if (named[0] == 'i') named = "The line" + named.substr(2);
        mistake.message += " " + named + ".";
    }
    return mistake;
}

}  // namespace kerf::documents
