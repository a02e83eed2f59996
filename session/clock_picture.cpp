// SPDX-License-Identifier: Apache-2.0
#include "session/clock_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "session/recorder.h"
#include "session/report/report_data.h"
#include "text/plain_numbers.h"

namespace kerf::session {
namespace {

constexpr double width = 1000.0, left = 70.0, right = 970.0, top = 80.0, bottom = 330.0;
constexpr double shortest = 0.5e-6;  // [s] left end of the axis of time; the first class ends at 1 us
constexpr const char* lateness_colour = "#1f77b4";
constexpr const char* compute_colour = "#d95f02";

template <class... Values>
std::string line(const char* format, Values... values) {
    std::array<char, 512> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

std::string text_at(double x, double y, const std::string& text, const char* attributes = "") {
    return line("<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, attributes) + html_escaped(text) + "</text>\n";
}

/// The axes of the histograms: time and number of ticks, both logarithmic.
class Axes {
public:
    explicit Axes(const ClockRow& clock) {
        std::uint64_t max_ticks = 1;
        for (const ClockRow::Class& one : clock.histogram) {
            if (one.lateness + one.compute > 0) longest_ = std::max(longest_, one.up_to);
            max_ticks = std::max({max_ticks, one.lateness, one.compute});
        }
        decades_ = std::log10(longest_ / shortest);
        count_decades_ = std::ceil(std::log10(static_cast<double>(max_ticks)) + 1e-9);
    }
    [[nodiscard]] double x(double seconds) const {
        return left + (right - left) * std::clamp(std::log10(seconds / shortest) / decades_, 0.0, 1.0);
    }
    /// One tick is a little above the axis, so that it can be seen.
    [[nodiscard]] double y(std::uint64_t ticks) const {
        if (ticks == 0) return bottom;
        return bottom - (bottom - top) * (std::log10(static_cast<double>(ticks)) + 0.3) / (count_decades_ + 0.3);
    }
    [[nodiscard]] std::string drawn() const {
        std::string svg;
        for (double time = 1e-6; time < 1.01 * longest_; time *= 10.0) {
            const double at = x(time);
            svg +=
                line("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", at, top, at, bottom);
            const std::string label = time < 0.9e-3 ? line("%.0f µs", time * 1e6)
                                      : time < 0.9  ? line("%.0f ms", time * 1e3)
                                                    : line("%.0f s", time);
            svg += text_at(at, bottom + 18, label, "text-anchor=\"middle\"");
        }
        for (int decade = 0; decade <= static_cast<int>(count_decades_); ++decade) {
            const auto ticks = static_cast<std::uint64_t>(std::llround(std::pow(10.0, decade)));
            svg += line("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>\n", left, y(ticks),
                        right, y(ticks));
            svg += text_at(left - 8, y(ticks) + 4, line("%llu", static_cast<unsigned long long>(ticks)),
                           "text-anchor=\"end\"");
        }
        return svg + text_at(right, bottom + 36, "time of a tick", "text-anchor=\"end\"") +
               text_at(left - 55, top - 10, "ticks");
    }

private:
    double longest_ = 1e-3, decades_ = 1.0, count_decades_ = 1.0;
};

/// Returns the outline of a histogram; its first class begins at the left end.
std::string steps(const ClockRow& clock, const Axes& axes, std::uint64_t ClockRow::Class::*ticks, const char* colour) {
    std::string path = line("M%.1f %.1f", left, bottom);
    double from = shortest;
    for (const ClockRow::Class& one : clock.histogram) {
        path += line(" L%.1f %.1f L%.1f %.1f", axes.x(from), axes.y(one.*ticks), axes.x(one.up_to), axes.y(one.*ticks));
        from = one.up_to;
    }
    path += line(" L%.1f %.1f Z", axes.x(from), bottom);
    return line("<path fill=\"%s\" fill-opacity=\"0.2\" stroke=\"%s\" stroke-width=\"1.5\" d=\"", colour, colour) +
           path + "\"/>\n";
}

std::string in_us(double seconds) { return line(seconds < 1e-4 ? "%.1f µs" : "%.0f µs", seconds * 1e6); }

std::string legend(const char* name, const ClockRow::Times& times, double y, const char* colour) {
    return line("<rect x=\"560\" y=\"%.1f\" width=\"12\" height=\"12\" fill=\"%s\" fill-opacity=\"0.6\"/>\n", y - 10,
                colour) +
           text_at(578, y,
                   std::string(name) + ": median " + in_us(times.median) + ", 99.9 % within " + in_us(times.p999) +
                       ", worst " + line("%.2f ms", times.worst * 1e3));
}

std::string table(const ClockRow& clock, double y) {
    struct Column {
        const char* head;
        double x;
        const char* anchor;
    };
    constexpr std::array<Column, 7> columns{{{"tick", 110, "end"},
                                             {"late", 180, "end"},
                                             {"due to done", 270, "end"},
                                             {"computed", 350, "end"},
                                             {"cause", 375, "start"},
                                             {"longest part of the tick", 590, "start"},
                                             {"page faults", 970, "end"}}};
    const auto row = [&](const std::array<std::string, 7>& cells, double at, const char* weight) {
        std::string svg;
        for (std::size_t c = 0; c < columns.size(); ++c)
            svg += text_at(columns[c].x, at, cells[c],
                           line("text-anchor=\"%s\" font-weight=\"%s\"", columns[c].anchor, weight).c_str());
        return svg;
    };
    std::array<std::string, 7> heads;
    for (std::size_t c = 0; c < columns.size(); ++c) heads[c] = columns[c].head;
    std::string svg = row(heads, y, "bold");
    for (const ClockRow::SlowTick& tick : clock.slowest) {
        y += 19;
        svg += row({std::to_string(tick.tick), line("%.3f ms", tick.lateness * 1e3),
                    line("%.3f ms", tick.response * 1e3), line("%.3f ms", tick.compute * 1e3), tick.cause,
                    tick.part + line(" %.3f ms", tick.part_time * 1e3), std::to_string(tick.page_faults)},
                   y, "normal");
    }
    return svg;
}

}  // namespace

std::string clock_svg(const RunSummary& summary, const ClockRow& clock) {
    const text::PlainNumbers plain;
    std::string causes;
    for (const auto& [cause, ticks] : clock.late_causes)
        if (ticks > 0) causes += (causes.empty() ? ": " : ", ") + std::to_string(ticks) + " " + cause;
    const double table_top = bottom + 80, height = table_top + 19.0 * static_cast<double>(clock.slowest.size()) + 50;
    const Axes axes(clock);
    return line("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" "
                "font-size=\"12\">\n<rect width=\"%.0f\" height=\"%.0f\" fill=\"white\"/>\n",
                width, height, width, height) +
           text_at(20, 26,
                   "The clock of " + summary.procedure + ", " +
                       (summary.leader.empty() ? summary.rehearsal : summary.leader),
                   "font-size=\"17\" font-weight=\"bold\"") +
           text_at(20, 46,
                   std::to_string(clock.ticks) + " ticks of " + line("%.3g ms", clock.period * 1e3) + ", " +
                       std::to_string(clock.late_ticks) + " late" + causes + line("; load %.1f, ", clock.load) +
                       clock.kernel + (clock.priority > 0 ? "" : ", without real time")) +
           axes.drawn() + steps(clock, axes, &ClockRow::Class::lateness, lateness_colour) +
           steps(clock, axes, &ClockRow::Class::compute, compute_colour) +
           legend("lateness", clock.lateness, top + 8, lateness_colour) +
           legend("computed", clock.compute, top + 28, compute_colour) + table(clock, table_top) +
           text_at(20, height - 16, std::string(notice_line) + ".", "fill=\"#555\"") + "</svg>\n";
}

}  // namespace kerf::session
