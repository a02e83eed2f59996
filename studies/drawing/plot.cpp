// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/drawing/plot.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "session/report/report_data.h"
#include "studies/drawing/svg.h"

namespace kerf::drawing {

namespace {

constexpr double room_left = 66, room_right = 118, room_top = 34, room_bottom = 44;  // px within a panel
constexpr double line_height = 14;

/// From values to pixels along one axis.
struct Scale {
    const Axis* axis;
    double from, to;  // px

    [[nodiscard]] double share(double value) const {
        const double v = std::clamp(value, axis->low, axis->high);
        if (!axis->is_log) return (v - axis->low) / (axis->high - axis->low);
        return std::log(v / axis->low) / std::log(axis->high / axis->low);
    }
    [[nodiscard]] double at(double value) const { return from + share(value) * (to - from); }
    [[nodiscard]] bool holds(double value) const { return value >= axis->low && value <= axis->high; }
};

struct Tick {
    double at;
    bool has_number;
};

/// Decades with their twos and fives; on a plain axis about five round steps.
std::vector<Tick> ticks_of(const Axis& axis) {
    std::vector<Tick> ticks;
    if (axis.is_log) {
        const double decades = std::log10(axis.high / axis.low);
        for (double decade = std::pow(10.0, std::floor(std::log10(axis.low))); decade <= axis.high * 1.001;
             decade *= 10.0)
            for (const double part : {1.0, 2.0, 5.0})
                if (part * decade >= axis.low * 0.999 && part * decade <= axis.high * 1.001)
                    ticks.push_back({part * decade, part == 1.0 || decades < 3.0});
        return ticks;
    }
    const double step = session::round_step(axis.high - axis.low);
    for (double at = std::ceil(axis.low / step - 1e-9) * step; at <= axis.high + 1e-9 * step; at += step)
        ticks.push_back({std::abs(at) < 1e-9 * step ? 0.0 : at, true});
    return ticks;
}

/// Written out as long as that is short.
std::string tick_text(double value) {
    const double size = std::abs(value);
    if (size != 0.0 && (size < 1e-5 || size >= 1e6)) return figure(value);
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, std::round(value * 1e9) / 1e9, std::chars_format::fixed);
    return {text, end.ptr};
}

std::string path(const std::string& data, const std::string& more) { return "<path d=\"" + data + "\" " + more + "/>"; }

std::string axes_svg(const Panel& panel, const Scale& x, const Scale& y) {
    std::string svg;
    for (const Tick& tick : ticks_of(panel.x)) {
        svg += path("M" + px(x.at(tick.at)) + " " + px(y.from) + "V" + px(y.to), "class=\"kp-grid\"");
        if (tick.has_number)
            svg += text_at(x.at(tick.at), y.from + 16, tick_text(tick.at), "class=\"kp-soft\" text-anchor=\"middle\"");
    }
    for (const Tick& tick : ticks_of(panel.y)) {
        svg += path("M" + px(x.from) + " " + px(y.at(tick.at)) + "H" + px(x.to), "class=\"kp-grid\"");
        if (tick.has_number)
            svg += text_at(x.from - 7, y.at(tick.at) + 4, tick_text(tick.at), "class=\"kp-soft\" text-anchor=\"end\"");
    }
    for (const Guide& guide : panel.x.guides) {
        if (!x.holds(guide.at)) continue;
        svg += path("M" + px(x.at(guide.at)) + " " + px(y.from) + "V" + px(y.to), "class=\"kp-guide\"");
        svg += text_at(x.at(guide.at) + 3, y.to + 11, guide.text, "class=\"kp-note\"");
    }
    for (const Guide& guide : panel.y.guides) {
        if (!y.holds(guide.at)) continue;
        svg += path("M" + px(x.from) + " " + px(y.at(guide.at)) + "H" + px(x.to), "class=\"kp-guide\"");
        svg += text_at(x.from + 4, y.at(guide.at) - 4, guide.text, "class=\"kp-note\"");
    }
    svg += path("M" + px(x.from) + " " + px(y.to) + "V" + px(y.from) + "H" + px(x.to), "class=\"kp-axis\"");
    svg += text_at(0.5 * (x.from + x.to), y.from + 34, panel.x.title, "text-anchor=\"middle\"");
    svg += text_at(x.from - room_left + 6, y.to - 8, panel.y.title, "");
    return svg;
}

std::string class_of(const Curve& curve) { return "kp-c" + std::to_string(curve.colour % colour_count); }

std::string curve_svg(const Curve& curve, const Scale& x, const Scale& y) {
    std::string line, marks;
    for (const Marker& m : curve.markers) {
        const double mx = x.at(m.x), my = y.at(m.y);
        line += (line.empty() ? "M" : "L") + px(mx) + " " + px(my);
        if (!curve.has_dots) continue;
        std::string one = "<g class=\"" + class_of(curve) + "\"><title>" + session::html_escaped(m.told) + "</title>";
        if (m.x_most > m.x)
            one += path("M" + px(mx) + " " + px(my) + "H" + px(x.at(m.x_most)) + "m0 -3v6", "class=\"kp-whisker\"");
        if (m.y_spread > 0.0)
            one += path("M" + px(mx) + " " + px(y.at(m.y - m.y_spread)) + "V" + px(y.at(m.y + m.y_spread)),
                        "class=\"kp-whisker\"");
        const bool is_filled = m.is_filled && x.holds(m.x) && y.holds(m.y);
        one += "<circle cx=\"" + px(mx) + "\" cy=\"" + px(my) + "\" r=\"" + (curve.is_bold ? "5" : "4") +
               "\" class=\"" + (is_filled ? "kp-full" : "kp-hollow") + "\"/>";
        // The last marker's label hangs below it, out of the way of its neighbours'.
        const bool is_below =
            curve.has_labels_below || (&m == &curve.markers.back() && curve.markers.size() > 1 && curve.has_line);
        if (!m.label.empty()) one += text_at(mx + 7, is_below ? my + 13 : my - 6, m.label, "class=\"kp-mark\"");
        marks += one + "</g>\n";
    }
    const std::string style = std::string("class=\"kp-line ") + class_of(curve) + (curve.is_bold ? " kp-bold" : "") +
                              (curve.is_dashed ? " kp-dashed" : "") + "\"";
    return (curve.has_line && curve.markers.size() > 1 ? path(line, style) + "\n" : "") + marks;
}

/// Names stand at the right border, at the height of their curve's last marker where there is room, else below or
/// above.
std::string names_svg(const Panel& panel, const Scale& x, const Scale& y) {
    struct Name {
        const Curve* curve;
        double wanted, at;
    };
    std::vector<Name> names;
    for (const Curve& curve : panel.curves)
        if (!curve.name.empty() && !curve.markers.empty()) {
            const double h = y.at(curve.markers.back().y);
            names.push_back({&curve, h, h});
        }
    std::sort(names.begin(), names.end(), [](const Name& a, const Name& b) { return a.wanted < b.wanted; });
    double free = y.to;
    for (Name& name : names) {
        name.at = std::max(name.at, free);
        free = name.at + line_height;
    }
    double limit = y.from;
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
        name->at = std::min(name->at, limit);
        limit = name->at - line_height;
    }
    std::string svg;
    for (const Name& name : names) {
        const Marker& last = name.curve->markers.back();
        svg += "<g class=\"" + class_of(*name.curve) + "\">" +
               path("M" + px(x.at(last.x) + 6) + " " + px(y.at(last.y)) + "L" + px(x.to + 4) + " " + px(name.at),
                    "class=\"kp-lead\"") +
               text_at(x.to + 8, name.at + 4, name.curve->name,
                       std::string("class=\"kp-name") + (name.curve->is_bold ? " kp-strong" : "") + "\"") +
               "</g>";
    }
    return svg;
}

std::string front_svg(const std::vector<Marker>& front, const Scale& x, const Scale& y) {
    if (front.empty()) return {};
    std::string line;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const std::string h = px(x.at(front[i].x)), v = px(y.at(front[i].y));
        line += i == 0 ? "M" + h + " " + px(y.to) + "V" + v : "H" + h + "V" + v;
    }
    line += "H" + px(x.to);
    return path(line, "class=\"kp-front\"") +
           text_at(x.to - 6, y.at(front.back().y) + 13, "Pareto front", "class=\"kp-note\" text-anchor=\"end\"");
}

}  // namespace

const char* plot_style() {
    return ".kp{--ink:#1b2126;--soft:#5b666f;--grid:#e9edf0;--paper:#fff;--guide:#b3261e}"
           ".kp text{fill:var(--ink);font:12px system-ui,'DejaVu Sans',sans-serif}"
           ".kp .kp-soft,.kp .kp-note{fill:var(--soft)}.kp .kp-note,.kp .kp-mark{font-size:10.5px;paint-order:stroke;"
           "stroke:var(--paper);stroke-width:3px;stroke-linejoin:round}"
           ".kp .kp-title{font-size:14px;font-weight:600}.kp .kp-strong{font-weight:700}"
           ".kp-paper{fill:var(--paper)}.kp-grid{stroke:var(--grid);fill:none}.kp-axis{stroke:var(--soft);fill:none}"
           ".kp-guide{stroke:var(--guide);stroke-dasharray:5 4;fill:none;opacity:.75}"
           ".kp-front{stroke:var(--soft);stroke-dasharray:2 3;fill:none;stroke-width:1.4}"
           ".kp-line{fill:none;stroke:var(--c);stroke-width:1.5;opacity:.8}.kp-bold{stroke-width:2.6;opacity:1}"
           ".kp-dashed{stroke-dasharray:6 3}.kp-whisker{stroke:var(--c);opacity:.45;fill:none}"
           ".kp-lead{stroke:var(--c);opacity:.3;fill:none}"
           ".kp-full{fill:var(--c);stroke:var(--c)}.kp-hollow{fill:var(--paper);stroke:var(--c);stroke-width:1.6}"
           ".kp .kp-name,.kp .kp-mark{fill:var(--c)}"
           ".kp-c0{--c:#0b6e6e}.kp-c1{--c:#1f5fbf}.kp-c2{--c:#2f7d32}.kp-c3{--c:#d97400}.kp-c4{--c:#7d6b00}"
           ".kp-c5{--c:#7b4fb0}.kp-c6{--c:#868e94}.kp-c7{--c:#a34672}.kp-c8{--c:#c62828}.kp-c9{--c:#6d4534}"
           "@media (prefers-color-scheme: "
           "dark){.kp{--ink:#e6eaed;--soft:#9aa6ae;--grid:#2a3136;--paper:#1c2125;--guide:#f2877f}"
           ".kp-c0{--c:#4fc9c2}.kp-c1{--c:#7fb2ff}.kp-c2{--c:#77cf7c}.kp-c3{--c:#f0a35a}.kp-c4{--c:#d9bf4f}"
           ".kp-c5{--c:#c0a0ee}.kp-c6{--c:#a9b3ba}.kp-c7{--c:#ec93bf}.kp-c8{--c:#ff8a80}.kp-c9{--c:#c9a18f}}";
}

std::string panel_svg(const Panel& panel, double left, double top, double width, double height) {
    const Scale x{&panel.x, left + room_left, left + width - room_right};
    const Scale y{&panel.y, top + height - room_bottom, top + room_top + line_height};
    std::string svg = "<g>" + text_at(left + 6, top + 14, panel.title, "class=\"kp-title\"");
    svg += axes_svg(panel, x, y) + front_svg(panel.front, x, y);
    for (const Curve& curve : panel.curves) svg += curve_svg(curve, x, y);
    return svg + names_svg(panel, x, y) + "</g>\n";
}

std::string marker_svg(double x, double y, int colour, bool is_filled) {
    return "<g class=\"kp-c" + std::to_string(colour % colour_count) + "\"><circle cx=\"" + px(x) + "\" cy=\"" + px(y) +
           "\" r=\"4\" class=\"" + (is_filled ? "kp-full" : "kp-hollow") + "\"/></g>";
}

std::string picture(double width, double height, const std::string& title, const std::string& content) {
    const std::string size = px(width) + " " + px(height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"kp\" viewBox=\"0 0 " + size + "\" width=\"" + px(width) +
           "\" height=\"" + px(height) + "\" role=\"img\"><title>" + session::html_escaped(title) + "</title><style>" +
           plot_style() + "</style><rect width=\"" + px(width) + "\" height=\"" + px(height) +
           "\" class=\"kp-paper\"/>\n" + content + "</svg>\n";
}

}  // namespace kerf::drawing
