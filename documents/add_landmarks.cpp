// SPDX-License-Identifier: Apache-2.0
#include "documents/add_landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "documents/made/anatomy_text.h"
#include "documents/names.h"
#include "documents/read_anatomy.h"
#include "documents/yaml/document.h"
#include "text/codes.h"

namespace kerf::documents {
namespace {

/// A landmark in the form `id: {…}`.
std::string entry_of(const LandmarkPoint& point) {
    using Lies = LandmarkPoint::Lies;
    constexpr std::string_view words[] = {"", ", lies: on_bone", ", lies: in_bone", ", lies: off_bone"};
    static_assert(static_cast<int>(Lies::off_bone) == 3);
    return point.id + ": {at: " + vector_text(1e3 * point.at) +
           " mm, tolerance: " + rounded_text(1e3 * point.tolerance) + " mm" +
           std::string(words[static_cast<std::size_t>(point.lies)]) + "}";
}
std::string entry_of(const LandmarkAxis& axis) {
    return axis.id + ": {from: " + vector_text(1e3 * axis.from) + " mm, to: " + vector_text(1e3 * axis.to) +
           " mm, tolerance: " + rounded_text(1e3 * axis.tolerance) + " mm}";
}

template <class T>
std::vector<std::string> entries_of(const std::vector<T>& landmarks) {
    std::vector<std::string> entries;
    for (const T& landmark : landmarks) entries.push_back(entry_of(landmark));
    return entries;
}

/// Entries of a map of landmarks, such as `points`.
struct Section {
    std::string key;
    std::vector<std::string> entries;
};

/// Returns a section as lines, each behind `indent` blanks and with `line_end`.
std::string block_of(const Section& section, std::size_t indent, const std::string& line_end) {
    std::string text = std::string(indent, ' ') + section.key + ":" + line_end;
    for (const std::string& entry : section.entries) text += std::string(indent + 2, ' ') + entry + line_end;
    return text;
}

std::string joined(const std::vector<std::string>& entries) {
    std::string text;
    for (const std::string& entry : entries) text += (text.empty() ? "" : ", ") + entry;
    return text;
}

// ---- positions in the text ----------------------------------------------------------------------------------------

std::size_t line_start(std::string_view text, std::size_t at) {
    const std::size_t end = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
    return end == std::string_view::npos ? 0 : end + 1;
}

std::size_t next_line(std::string_view text, std::size_t at) {
    const std::size_t end = text.find('\n', at);
    return end == std::string_view::npos ? text.size() : end + 1;
}

std::size_t column_of(std::string_view text, std::size_t at) { return at - line_start(text, at); }

/// Returns whether a line is blank, ends the document, or is a comment to the left of `column`.
bool belongs_to_none(std::string_view line, std::size_t column) {
    const std::size_t first = line.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos || (line[first] == '#' && first < column) || line.starts_with("...");
}

/// Returns where the last line of a block ends, given a position behind it and one within it.
std::size_t end_of_block(std::string_view text, std::size_t within, std::size_t behind, std::size_t column) {
    std::size_t end = behind == text.size() ? behind : line_start(text, behind);
    while (end > next_line(text, within)) {
        const std::size_t begin = line_start(text, end - 1);
        if (!belongs_to_none(text.substr(begin, end - begin), column)) break;
        end = begin;
    }
    return end;
}

/// Finds where to insert, and inserts.
class Inserter {
public:
    explicit Inserter(const Document& document)
        : text_(document.text()),
          root_(document.root),
          line_end_(text_.find("\r\n") != std::string::npos ? "\r\n" : "\n") {}

    [[nodiscard]] std::string with(const Section& section) const {
        const Node* landmarks = root_.find("landmarks");
        if (landmarks == nullptr) return with_all(section);
        const Node* there = landmarks->find(section.key);
        const std::size_t behind = next_key(root_, *landmarks, text_.size());
        if (there != nullptr) return with_entries(*there, section, next_key(*landmarks, *there, behind));
        if (is_flow(*landmarks)) return in_flow(*landmarks, section.key + ": {" + joined(section.entries) + "}");
        if (landmarks->children.empty())
            return with_lines(next_line(text_, landmarks->key_span.begin),
                              block_of(section, column_of(text_, landmarks->key_span.begin) + 2, line_end_));
        const std::size_t column = column_of(text_, landmarks->children.front().key_span.begin);
        return with_lines(end_of(*landmarks, behind, column), block_of(section, column, line_end_));
    }

private:
    /// Adds `landmarks:` at the end of the document.
    [[nodiscard]] std::string with_all(const Section& section) const {
        if (is_flow(root_))
            return in_flow(root_, "landmarks: {" + section.key + ": {" + joined(section.entries) + "}}");
        return with_lines(end_of(root_, text_.size(), 1),
                          line_end_ + "landmarks:" + line_end_ + block_of(section, 2, line_end_));
    }

    [[nodiscard]] std::string with_entries(const Node& map, const Section& section, std::size_t behind) const {
        if (is_flow(map)) return in_flow(map, joined(section.entries));
        const bool has_none = map.children.empty();
        const std::size_t column =
            has_none ? column_of(text_, map.key_span.begin) + 2 : column_of(text_, map.children.front().key_span.begin);
        std::string lines;
        for (const std::string& entry : section.entries) lines += std::string(column, ' ') + entry + line_end_;
        return with_lines(has_none ? next_line(text_, map.key_span.begin) : end_of(map, behind, column), lines);
    }

    [[nodiscard]] bool is_flow(const Node& map) const {
        return map.kind == Node::Kind::map && map.span.begin < text_.size() && text_[map.span.begin] == '{';
    }

    /// Returns where the key behind a child begins; `behind` if the child is the last one.
    [[nodiscard]] static std::size_t next_key(const Node& map, const Node& child, std::size_t behind) {
        const auto index = static_cast<std::size_t>(&child - map.children.data());
        return index + 1 < map.children.size() ? map.children[index + 1].key_span.begin : behind;
    }

    [[nodiscard]] std::size_t end_of(const Node& map, std::size_t behind, std::size_t column) const {
        return end_of_block(text_, map.children.back().key_span.begin, behind, column);
    }

    [[nodiscard]] std::string in_flow(const Node& map, std::string words) const {
        if (!map.children.empty()) words += ", ";
        std::string all = text_;
        return all.insert(map.span.begin + 1, words);
    }

    [[nodiscard]] std::string with_lines(std::size_t at, std::string lines) const {
        std::string all = text_;
        if (at > 0 && all[at - 1] != '\n') lines.insert(0, line_end_);
        return all.insert(at, lines);
    }

    const std::string& text_;
    const Node& root_;
    std::string line_end_;
};

// ---- the check ----------------------------------------------------------------------------------------------------

constexpr double rounding = 0.006e-3;  // [m] of a coordinate

bool is_near(Vec3 a, Vec3 b, double within) {
    const Vec3 d = a - b;
    return std::abs(d.x) <= within && std::abs(d.y) <= within && std::abs(d.z) <= within;
}
bool is_same(const LandmarkPoint& a, const LandmarkPoint& b, double within) { return is_near(a.at, b.at, within); }
bool is_same(const LandmarkAxis& a, const LandmarkAxis& b, double within) {
    return is_near(a.from, b.from, within) && is_near(a.to, b.to, within);
}

template <class T>
bool has_all(const std::vector<T>& all, const std::vector<T>& some, double within) {
    return std::all_of(some.begin(), some.end(), [&](const T& one) {
        const T* found = find_id(all, one.id);
        return found != nullptr && is_same(*found, one, within);
    });
}

template <class T>
bool is_sum(const std::vector<T>& all, const std::vector<T>& before, const std::vector<T>& added) {
    return all.size() == before.size() + added.size() && has_all(all, before, 0.0) && has_all(all, added, rounding);
}

text::Diagnostic no_form(const std::string& file) {
    return text::error_about(
        file, text::code_text(text::Code::wrong_shape),
        "`landmarks` has a form to which nothing can be added. Write it as `landmarks:`, `points:` "
        "and a line for each point, or copy the new landmarks and paste them.");
}

}  // namespace

std::string landmarks_text(const NewLandmarks& added) {
    std::string text;
    if (!added.points.empty()) text += block_of({"points", entries_of(added.points)}, 2, "\n");
    if (!added.axes.empty()) text += block_of({"axes", entries_of(added.axes)}, 2, "\n");
    return text;
}

text::Result<std::string> with_landmarks(const std::string& file, const std::string& text, const NewLandmarks& added) {
    std::string all = text;
    for (const Section& section :
         {Section{"points", entries_of(added.points)}, Section{"axes", entries_of(added.axes)}}) {
        if (section.entries.empty()) continue;
        text::Diagnostics diagnostics;
        const auto document = parse_document(file, all).take(diagnostics);
        if (!document || text::has_error(diagnostics)) return diagnostics;
        if (document->root.kind != Node::Kind::map || document->root.children.empty())
            return text::Diagnostics{no_form(file)};
        all = Inserter(*document).with(section);
    }
    text::Diagnostics diagnostics, ignored;
    const auto after = read_anatomy_text(file, all).take(diagnostics);
    if (!after) return diagnostics;
    Anatomy before;
    if (auto draft = read_anatomy_draft_text(file, text).take(ignored)) before = std::move(draft->anatomy);
    if (!is_sum(after->points, before.points, added.points) || !is_sum(after->axes, before.axes, added.axes) ||
        after->planes.size() != before.planes.size())
        return text::Diagnostics{no_form(file)};
    return {std::move(all), std::move(diagnostics)};
}

}  // namespace kerf::documents
