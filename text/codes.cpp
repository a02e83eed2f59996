// SPDX-License-Identifier: Apache-2.0
#include "text/codes.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <ranges>
#include <system_error>

namespace kerf::text {
namespace {

constexpr bool error = false, warning = true;

constexpr CodeEntry entries[] = {
#define KERF_CODE(number, id, level, name, meaning, why, write) {number, #id, name, meaning, why, write, level},
#include "text/codes_1_document.def"
#include "text/codes_5_anatomy.def"
#include "text/codes_6_data.def"
#include "text/codes_7_run.def"
#undef KERF_CODE
};

/// `text` in lines of at most 100 characters, each after `indent`.
std::string wrapped(std::string_view text, std::string_view indent) {
    std::string out(indent);
    std::size_t column = indent.size();
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const bool is_first = column == indent.size();
        if (column + 1 + end > 100 && !is_first) {
            out.append("\n").append(indent);
            column = indent.size();
        } else if (!is_first) {
            out += ' ';
            ++column;
        }
        out.append(text.substr(0, end));
        column += end;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out + "\n";
}

std::string text_of(const CodeEntry& entry) {
    return code_text(static_cast<Code>(entry.number), entry.is_warning ? 'W' : 'E');
}

}  // namespace

std::span<const CodeEntry> all_codes() noexcept { return entries; }

const CodeEntry* find_code(std::string_view text) noexcept {
    if (text.starts_with('E') || text.starts_with('W') || text.starts_with('e') || text.starts_with('w'))
        text.remove_prefix(1);
    int number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size()) return nullptr;
    const auto found = std::ranges::find(entries, number, &CodeEntry::number);
    return found != std::end(entries) ? found : nullptr;
}

std::string explanation_of(const CodeEntry& entry) {
    return text_of(entry) + "  " + entry.name + "\n\n" + wrapped(entry.meaning, "  ") + "\n  Why it matters\n" +
           wrapped(entry.why, "    ") + "\n  What to do\n" + wrapped(entry.write, "    ");
}

std::string list_of_codes() {
    std::string text;
    for (const CodeEntry& entry : entries) text += text_of(entry) + "  " + entry.name + "\n";
    return text;
}

std::string table_of_codes() {
    std::string text = "| code | mistake | meaning | remedy |\n|---|---|---|---|\n";
    for (const CodeEntry& entry : entries)
        text += "| " + text_of(entry) + " | " + entry.name + " | " + entry.meaning + " | " + entry.write + " |\n";
    return text;
}

}  // namespace kerf::text
