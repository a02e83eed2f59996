// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "session/recorder.h"
#include "session/report/report_data.h"
#include "studies/drawing/svg.h"
#include "studies/stability/atlas.h"

namespace kerf::stability {

namespace {

using drawing::text_at;

constexpr int cell = 18, left = 490, top = 118, gap = 10;  // px

struct Column {
    std::string device, hand;
    int delay;
    bool operator==(const Column&) const = default;
};
struct Row {
    std::string test, scene;
    Method method;
    bool operator==(const Row&) const = default;
};

template <class T>
std::size_t index_in(std::vector<T>& known, const T& item) {
    const auto at = std::find(known.begin(), known.end(), item);
    if (at != known.end()) return static_cast<std::size_t>(at - known.begin());
    known.push_back(item);
    return known.size() - 1;
}

int severity(Outcome outcome) { return outcome == Outcome::fail ? 2 : outcome == Outcome::pass ? 1 : 0; }

struct Cell {
    Outcome outcome = Outcome::not_applicable;
    std::string told;
};

/// What stands where, in an order a reader expects.
struct Layout {
    std::vector<Column> columns;
    std::vector<Row> rows;
    std::map<std::pair<std::size_t, std::size_t>, Cell> cells;  ///< by row and column

    explicit Layout(std::span<const Finding> findings) {
        std::vector<std::string> devices, hands{led};
        for (const Finding& f : findings) {
            (void)index_in(devices, f.device);
            (void)index_in(hands, f.hand);
            (void)index_in(columns, Column{f.device, f.hand, f.delay});
            (void)index_in(rows, Row{f.test, f.scene, f.method});
        }
        std::stable_sort(columns.begin(), columns.end(), [&](const Column& a, const Column& b) {
            const auto key = [&](const Column& c) {
                return std::tuple(index_in(devices, c.device), index_in(hands, c.hand), c.delay);
            };
            return key(a) < key(b);
        });
        std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.test < b.test; });
        for (const Finding& f : findings) {
            Cell& at =
                cells[{index_in(rows, {f.test, f.scene, f.method}), index_in(columns, {f.device, f.hand, f.delay})}];
            if (severity(f.outcome) > severity(at.outcome)) at.outcome = f.outcome;
            at.told +=
                std::string(to_text(f.outcome)) + ": " + f.measured + " (" + f.criterion + ") " + f.reason + "\n";
        }
    }
    /// Columns of different devices stand apart.
    [[nodiscard]] int x_of(std::size_t column) const {
        int x = left + cell * static_cast<int>(column);
        for (std::size_t c = 1; c <= column; ++c)
            if (columns[c].device != columns[c - 1].device) x += gap;
        return x;
    }
};

std::string mark(int x, int y, Outcome outcome, Method method, const std::string& told) {
    const std::string place = "x=\"" + std::to_string(x + 2) + "\" y=\"" + std::to_string(y + 2) + "\" ";
    const std::string size = "width=\"" + std::to_string(cell - 4) + "\" height=\"" + std::to_string(cell - 4) + "\" ";
    std::string style = "class=\"na\" ";
    if (outcome == Outcome::pass) style = method == Method::kerf ? "class=\"ours\" " : "class=\"theirs\" ";
    if (outcome == Outcome::fail) style = "class=\"bad\" ";
    std::string text = "<g><title>" + session::html_escaped(told) + "</title><rect " + place + size + style + "/>";
    const auto line = [&](int x1, int y1, int x2, int y2, const char* kind) {
        return "<path class=\"" + std::string(kind) + "\" d=\"M" + std::to_string(x + x1) + " " +
               std::to_string(y + y1) + "L" + std::to_string(x + x2) + " " + std::to_string(y + y2) + "\"/>";
    };
    if (outcome == Outcome::fail)
        text += line(6, 6, cell - 6, cell - 6, "cross") + line(6, cell - 6, cell - 6, 6, "cross");
    if (outcome == Outcome::not_applicable) text += line(6, cell / 2, cell - 6, cell / 2, "dash");
    return text + "</g>\n";
}

std::string column_heads(const Layout& layout) {
    std::string text;
    for (std::size_t c = 0; c < layout.columns.size(); ++c) {
        const Column& column = layout.columns[c];
        const bool is_first = c == 0 || layout.columns[c - 1].device != column.device;
        const int x = layout.x_of(c);
        if (is_first) text += text_at(x + 2, top - 80, column.device, "class=\"head\"");
        if (is_first || layout.columns[c - 1].hand != column.hand)
            text += text_at(
                0, 0, column.hand,
                "transform=\"translate(" + std::to_string(x + 13) + "," + std::to_string(top - 22) + ") rotate(-60)\"");
        text += text_at(x + cell / 2, top - 6, std::to_string(column.delay), "class=\"delay\"");
    }
    return text;
}

std::string legend(int y) {
    std::string text;
    int x = 12;
    const auto add = [&](Outcome outcome, Method method, const char* what, int width) {
        text += mark(x, y - 13, outcome, method, what) + text_at(x + cell + 4, y, what);
        x += width;
    };
    add(Outcome::pass, Method::kerf, "Kerf passes", 120);
    add(Outcome::pass, Method::as_printed, "as printed passes", 150);
    add(Outcome::fail, Method::kerf, "fails", 80);
    add(Outcome::not_applicable, Method::kerf, "not applicable: the table says why", 260);
    return text + text_at(x, y, "empty: not tested. Figures: rest the pointer on a cell, or stability.csv.");
}

}  // namespace

std::string atlas_svg(std::span<const Finding> findings) {
    const Layout layout(findings);
    const int right = layout.columns.empty() ? left : layout.x_of(layout.columns.size() - 1) + cell + 20;
    const int width = std::max(right, 900), bottom = top + cell * static_cast<int>(layout.rows.size());
    const std::string size = "width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(bottom + 70) + "\"";
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " font-family=\"sans-serif\" font-size=\"12\">\n" +
        "<style>.ours{fill:#0b6e6e}.theirs{fill:#8fa3ad}.bad{fill:#fff;stroke:#c62828;stroke-width:1.6}"
        ".na{fill:none}.cross{stroke:#c62828;stroke-width:1.4}.dash{stroke:#aaa;stroke-width:1.4}"
        ".head{font-weight:bold}.delay{text-anchor:middle;fill:#666;font-size:10px}.soft{fill:#666}"
        ".title{font-size:16px;font-weight:bold}.kerf{fill:#0b6e6e;font-weight:bold}</style>\n" +
        "<rect " + size + " fill=\"#fff\"/>\n" + text_at(12, 22, "Stability: where methods fail", "class=\"title\"") +
        text_at(12, top - 6, "test and method; columns: device, hand, delay in ticks", "class=\"soft\"") +
        column_heads(layout);
    for (std::size_t r = 0; r < layout.rows.size(); ++r) {
        const Row& row = layout.rows[r];
        const int y = top + cell * static_cast<int>(r);
        if (r % 2 == 0)
            svg += "<rect x=\"0\" y=\"" + std::to_string(y) + "\" width=\"" + std::to_string(width) + "\" height=\"" +
                   std::to_string(cell) + "\" fill=\"#f3f5f6\"/>\n";
        svg += text_at(12, y + 13, row.test) + text_at(48, y + 13, row.scene) +
               text_at(left - 84, y + 13, to_text(row.method),
                       row.method == Method::kerf ? "class=\"kerf\"" : "class=\"soft\"");
        for (std::size_t c = 0; c < layout.columns.size(); ++c)
            if (const auto at = layout.cells.find({r, c}); at != layout.cells.end())
                svg += mark(layout.x_of(c), y, at->second.outcome, row.method, at->second.told);
    }
    return svg + legend(bottom + 26) +
           text_at(12, bottom + 52, std::string(session::notice_line) + ".", "class=\"soft\"") + "</svg>\n";
}

}  // namespace kerf::stability
