// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/explain_syntax.h"

#include <yaml-cpp/exceptions.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <utility>
#include <vector>

namespace kerf {
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
    return unclosed.is_last_line ? "The file ends in the middle of what this " + open + " begins: the " + close +
                                       " that closes it is missing. Is the file cut off?"
                                 : "This " + open + " is never closed. Put " + close + " where what it begins ends.";
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

bool is_about_an_end(const std::string& complaint) {
    namespace M = YAML::ErrorMsg;
    return std::ranges::any_of(
        std::array{M::END_OF_MAP_FLOW, M::END_OF_SEQ_FLOW, M::UNKNOWN_TOKEN, M::EOF_IN_SCALAR, M::FLOW_END},
        [&](const char* message) { return complaint == message; });
}

std::string explain_syntax(const std::string& complaint, std::string_view line) {
    namespace M = YAML::ErrorMsg;
    const std::size_t indent = std::min(line.find_first_not_of(blanks), line.size());
    if (line.substr(0, indent).find('\t') != std::string_view::npos)
        return "a tab stands at the beginning of the line. Indent with spaces";
    const std::array<std::pair<const char*, const char*>, 10> meanings{{
        {M::MAP_VALUE,
         "a `:` stands where no key can be. Is the line indented wrongly? Text that holds `: ` needs quotation marks"},
        {M::MAP_KEY, "a key stands where none can be. Is the line indented wrongly?"},
        {M::BLOCK_ENTRY,
         "a `-` stands where no list can begin. Put it on a line of its own, indented like its neighbours"},
        {M::END_OF_MAP, "this line is indented like none above it. Indent it like the keys it belongs to"},
        {M::END_OF_SEQ, "this line is indented like none above it. Indent it like the items it belongs to"},
        {M::UNKNOWN_TOKEN, "this cannot stand here. Text that begins so needs quotation marks"},
        {M::END_OF_MAP_FLOW,
         "this cannot stand between `{` and `}`. Put text that holds `: ` or `,` into quotation marks"},
        {M::END_OF_SEQ_FLOW,
         "this cannot stand between `[` and `]`. Put text that holds `: ` or `,` into quotation marks"},
        {M::FLOW_END, "this closes a `[` or `{` that was not opened. Remove it, or open it before"},
        {M::EOF_IN_SCALAR, "the file ends in the middle of a text in quotation marks"},
    }};
    for (const auto& [message, meaning] : meanings)
        if (complaint == message) return meaning;
    return complaint;
}

}  // namespace kerf
