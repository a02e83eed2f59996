// SPDX-License-Identifier: Apache-2.0
#include "documents/consequences.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace kerf::documents {
namespace {

constexpr std::size_t max_lines = 8;  // that a message lists

bool is_same(const text::Diagnostic& a, const text::Diagnostic& b) {
    return a.code == b.code && a.message == b.message && a.place.file == b.place.file;
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
    return d.code.starts_with("E03") && d.message.starts_with(start);
}

}  // namespace

void merge_repeated(text::Diagnostics& diagnostics) {
    text::Diagnostics merged;
    std::vector<std::vector<int>> lines;  // of each merged one: the others
    for (text::Diagnostic& d : diagnostics) {
        const auto first = !d.code.starts_with("E03")
                               ? merged.end()
                               : std::find_if(merged.begin(), merged.end(),
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
