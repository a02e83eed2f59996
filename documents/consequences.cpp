// SPDX-License-Identifier: Apache-2.0
#include "documents/consequences.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "text/codes.h"

namespace kerf::documents {
namespace {

constexpr std::size_t max_lines = 8;  // that a message lists

bool is_unknown_name(const text::Diagnostic& d) { return d.code.starts_with("E03"); }

bool is_about_a_name(const text::Diagnostic& d) {
    return is_unknown_name(d) || d.code == text::code_text(text::Code::patch_nowhere);
}

/// Returns the first name in backquotes, or nothing.
std::string first_quoted(const std::string& message) {
    const std::size_t begin = message.find('`'), end = message.find('`', begin + 1);
    return end == std::string::npos ? std::string() : message.substr(begin + 1, end - begin - 1);
}

bool is_same(const text::Diagnostic& a, const text::Diagnostic& b) {
    return is_about_a_name(a) && a.code == b.code && a.message == b.message && a.place.file == b.place.file;
}

/// Returns " The same in lines 74, 87 and 100."
std::string text_of_lines(const std::vector<int>& lines) {
    std::string text = lines.size() == 1 ? " The same in line " : " The same in lines ";
    for (std::size_t i = 0; i < std::min(lines.size(), max_lines); ++i)
        text += (i == 0 ? "" : i + 1 == lines.size() ? " and " : ", ") + std::to_string(lines[i]);
    if (lines.size() > max_lines) text += " and " + std::to_string(lines.size() - max_lines) + " more";
    return text + ".";
}

bool is_about(const text::Diagnostic& d, const std::string& start) {
    return is_unknown_name(d) && d.message.starts_with(start);
}

}  // namespace

void merge_repeated(text::Diagnostics& diagnostics) {
    text::Diagnostics merged;
    std::vector<std::vector<int>> lines;  // of each merged one: the others
    for (text::Diagnostic& d : diagnostics) {
        const auto first = std::find_if(merged.begin(), merged.end(),
                                        [&](const text::Diagnostic& other) { return is_same(d, other); });
        if (first != merged.end()) {
            std::vector<int>& others = lines[static_cast<std::size_t>(first - merged.begin())];
            if (d.place.line != first->place.line && (others.empty() || others.back() != d.place.line))
                others.push_back(d.place.line);
        } else {
            merged.push_back(std::move(d));
            lines.emplace_back();
        }
    }
    for (std::size_t i = 0; i < merged.size(); ++i)
        if (!lines[i].empty()) merged[i].message += text_of_lines(lines[i]);
    diagnostics = std::move(merged);
}

void drop_lost_names(text::Diagnostics& diagnostics) {
    const auto is_twice = [](const text::Diagnostic& d) { return d.code == text::code_text(text::Code::duplicate_id); };
    std::set<std::string> sorts;  // "The step `"
    for (const text::Diagnostic& d : diagnostics)
        if (is_twice(d)) sorts.insert(d.message.substr(0, d.message.find('`') + 1));
    for (const std::string& sort : sorts) {
        std::set<std::string> lost;
        std::erase_if(diagnostics, [&](const text::Diagnostic& d) {
            const bool is_lost = is_unknown_name(d) && d.message.starts_with(sort);
            if (is_lost) lost.insert(first_quoted(d.message));
            return is_lost;
        });
        if (lost.size() != 1) continue;
        for (text::Diagnostic& d : diagnostics)
            if (is_twice(d) && d.message.starts_with(sort)) d.write = *lost.begin();
    }
}

std::string undeclared_text(const std::string& what, const std::string& name) {
    return "The " + what + " `" + name + "` is not declared:";
}

bool is_reported_undeclared(const text::Diagnostics& diagnostics, const std::string& what, const std::string& name) {
    const std::string start = undeclared_text(what, name);
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [&](const text::Diagnostic& d) { return is_about(d, start); });
}

void drop_undeclared(text::Diagnostics& diagnostics, const std::string& what, const std::string& name) {
    const std::string start = undeclared_text(what, name);
    std::erase_if(diagnostics, [&](const text::Diagnostic& d) { return is_about(d, start); });
}

}  // namespace kerf::documents
