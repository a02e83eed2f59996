// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_data.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <ranges>
#include <utility>

#include "session/report/force_charts.h"
#include "session/report/metric_cells.h"
#include "session/report/report_zones.h"
#include "session/report/step_series.h"
#include "session/report/timeline.h"
#include "text/distinguishing_digits.h"
#include "text/palette.h"
#include "text/plain_numbers.h"
#include "text/printable_lines.h"

namespace kerf::session {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<unsigned char>;

/// Appends the low `size` bytes, least significant first.
void put(Bytes& bytes, std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

/// Drops the sign of a zero and the bits of a NaN, which a session does not store. So a page made from a session is
/// identical.
float plain(double value) {
    return std::isnan(value) ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value) + 0.0f;
}

template <class GetValue>
std::string packed_floats(const std::vector<TickRow>& drawn, GetValue get_value) {
    Bytes bytes;
    bytes.reserve(4 * drawn.size());
    for (const TickRow& row : drawn) put(bytes, std::bit_cast<std::uint32_t>(plain(get_value(row))), 4);
    return base64(bytes);
}

Json rows_json(const std::vector<TickRow>& drawn) {
    Bytes tissues;
    for (const TickRow& row : drawn) put(tissues, static_cast<std::uint32_t>(std::clamp(row.tissue, -1, 127)), 1);
    return {{"count", drawn.size()},
            {"time", packed_floats(drawn, [](const TickRow& row) { return row.time; })},
            {"thrust", packed_floats(drawn, [](const TickRow& row) { return row.thrust; })},
            {"torque", packed_floats(drawn, [](const TickRow& row) { return row.torque * 1e3; })},
            {"sent", packed_floats(drawn, [](const TickRow& row) { return sent_torque(row) * 1e3; })},
            {"lateral", packed_floats(drawn, [](const TickRow& row) { return lateral_force(row); })},
            {"depth", packed_floats(drawn, [](const TickRow& row) { return row.depth * 1e3; })},
            {"tissue", base64(tissues)}};
}

Json signals_json(const std::vector<SignalColumn>& signals, const std::vector<TickRow>& drawn) {
    Json list = Json::array();
    for (std::size_t s = 0; s < std::min<std::size_t>(signals.size(), max_signal_columns); ++s) {
        const double per_unit = signals[s].per_unit;
        list.push_back(
            {{"name", signals[s].id},
             {"unit", unit_for_people(signals[s].unit)},
             {"values", packed_floats(drawn, [&](const TickRow& row) { return row.signals[s] / per_unit; })}});
    }
    return list;
}

Json lines_json(const std::vector<BoundLine>& lines) {
    Json list = Json::array();
    for (const BoundLine& line : lines)
        list.push_back({{"value", line.value}, {"text", line.text}, {"isGoal", line.is_goal}});
    return list;
}

/// Returns the steps that were reached: their rows, strokes, goals and limits.
Json steps_json(const RunSummary& summary, const DrawnRun& run, const RecordedProcedure& procedure,
                const std::vector<TickRow>& drawn) {
    Json list = Json::array();
    for (const StepSeries& series : series_by_step(drawn)) {
        if (series.step >= summary.steps.size() || !run.has_met_bone(series.step)) continue;
        const StepRow& step = summary.steps[series.step];
        const RecordedStep& demands = demands_of(procedure, step.id);
        Json strokes = Json::array(), limits = Json::object();
        for (const Stroke& stroke : series.strokes)
            strokes.push_back({series.first + stroke.begin, series.first + stroke.end, stroke.is_inward});
        for (const ChartedLoad& load : charted_loads(demands))
            limits[load.quantity] = lines_json(load_lines(demands, load));
        list.push_back({{"title", step.title.empty() ? step.id : step.title},
                        {"begin", series.first},
                        {"end", series.first + series.rows.size()},
                        {"strokes", std::move(strokes)},
                        {"limits", std::move(limits)},
                        {"depths", lines_json(depth_lines(demands))}});
    }
    return list;
}

Json moments_json(const RunSummary& summary) {
    Json list = Json::array();
    for (const Moment& moment : moments_of(summary))
        list.push_back({{"numbers", moment.numbers}, {"time", moment.time}});
    return list;
}

bool is_failure_event(const std::string& event_id) {
    return std::ranges::any_of(std::array{"limit", "fault", "breach", "quarantine", "zone_entered"},
                               [&](const char* word) { return event_id.find(word) != std::string::npos; });
}

Json events_json(const std::vector<EventRow>& events) {
    Json list = Json::array();
    for (const EventRow& event : events)
        list.push_back(
            {{"time", event.time}, {"id", event.id}, {"detail", event.detail}, {"isBad", is_failure_event(event.id)}});
    return list;
}

/// Returns the direction from the bone towards the eye: back along the tool at its deepest point, so that the eye sees
/// into the hole.
Vec3 direction_of_view(const std::optional<TickRow>& deepest) {
    const Vec3 from_the_front{0, -1, 0};
    if (!deepest || !is_finite(deepest->world_from_tool)) return from_the_front;
    const Vec3 back =
        Vec3{0, 0, 0} - normalized(rotate(deepest->world_from_tool.rotation, {0, 0, 1}));  // makes −0 to 0, as above
    return length(back) > 0.5 ? back : from_the_front;
}

Json mesh_json(const DrawnSurface& surface, Vec3 look) {
    if (surface.is_empty()) return nullptr;
    const Vec3 half = surface.half_size;
    return {{"unit", surface.step * 1e3},         {"halfSize", {half.x * 1e3, half.y * 1e3, half.z * 1e3}},
            {"look", {look.x, look.y, look.z}},   {"positions", base64(surface.positions)},
            {"normals", base64(surface.normals)}, {"tissue", base64(surface.tissues)},
            {"isShort", surface.is_short()},      {"triangles", base64(surface.triangles)}};
}

Json mm_json(Vec3 metres) {
    return {metres.x * 1e3 + 0.0, metres.y * 1e3 + 0.0, metres.z * 1e3 + 0.0};  // makes −0 to 0, as above
}

/// Returns the zones, relative to the middle of the bone's box; none for a bone whose middle is unknown.
Json zones_json(const RunSummary& summary, const DrawnSurface& bone) {
    Json list = Json::array();
    for (std::size_t i = 0; i < summary.zones.size(); ++i) {
        const DrawnSurface& surface = summary.zones[i].surface;
        if (surface.is_empty() || bone.is_empty()) continue;
        list.push_back({{"name", words_of(summary.zones[i].id)},
                        {"colour", zone_colour(i)},
                        {"unit", surface.step * 1e3},
                        {"centre", mm_json(surface.centre - bone.centre)},
                        {"halfSize", mm_json(surface.half_size)},
                        {"positions", base64(surface.positions)},
                        {"normals", base64(surface.normals)},
                        {"isShort", surface.is_short()},
                        {"triangles", base64(surface.triangles)}});
    }
    return list;
}

Json approaches_json(const RunSummary& summary, const DrawnSurface& bone) {
    Json list = Json::array();
    for (const ApproachRow& row : marked_approaches(summary))
        list.push_back(
            {{"text", approach_text(row)}, {"at", mm_json(row.at - bone.centre)}, {"isBad", is_bad(row, summary)}});
    return list;
}

constexpr int max_decimals = 12;  ///< of a value next to its bound

/// Replaces the hyphen by "−", and removes it for zero.
std::string with_minus(std::string digits) {
    if (!digits.starts_with('-')) return digits;
    const bool is_zero = digits.find_first_not_of("-0.") == std::string::npos;
    return digits.replace(0, 1, is_zero ? "" : "−");
}

}  // namespace

std::string base64(std::span<const unsigned char> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = (three << 8) | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[(three >> (18 - 6 * k)) & 63u] : '=';
    }
    return text;
}

std::string html_escaped(std::string_view text) {
    std::string safe;
    for (const char c : text::printable_lines(text)) switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            case '\'':
                safe += "&#39;";
                break;
            default:
                safe += c;
        }
    return safe;
}

std::string sensible_number(double value, double uncertainty, std::span<const double> bounds) {
    if (!std::isfinite(value)) return "–";
    const auto decimals_for = [](double size, int digits) {
        return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
    };
    int decimals = 0;
    const bool is_known = uncertainty > 0.0 && std::isfinite(uncertainty);
    if (is_known) {
        decimals = decimals_for(uncertainty, 1);
        if (uncertainty * std::pow(10.0, decimals) < 1.95) decimals = decimals_for(uncertainty, 2);  // 0.12, not 0.1
    } else if (value != 0.0) {
        decimals = decimals_for(std::abs(value), 3);
    }
    const text::PlainNumbers point;
    const auto text_of = [](double number, int places) {
        char digits[400];
        std::snprintf(digits, sizeof digits, "%.*f", places, number);
        return std::string(digits);
    };
    int enough = decimals;
    for (const double bound : bounds)
        enough = std::max(enough, text::distinguishing_digits(value, bound, decimals, max_decimals, text_of));
    std::string text = text_of(value, enough);

    if (!is_known && text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
    }
    return with_minus(std::move(text));
}

std::string number_as_written(double value) {
    if (!std::isfinite(value)) return "–";
    const text::PlainNumbers point;
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.10g", value);
    return with_minus(digits);
}

std::string unit_for_people(const std::string& unit) {
    constexpr std::array<std::pair<const char*, const char*>, 8> pretty{{{"mm2", "mm²"},
                                                                         {"mm3", "mm³"},
                                                                         {"um", "µm"},
                                                                         {"deg", "°"},
                                                                         {"N*m", "N·m"},
                                                                         {"N m", "N·m"},
                                                                         {"N*mm", "N·mm"},
                                                                         {"Nmm", "N·mm"}}};
    for (const auto& [plain, nice] : pretty)
        if (unit == plain) return nice;
    return unit;
}

double round_step(double range) {
    const double power = std::pow(10.0, std::floor(std::log10(range / 5.0)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= range / 5.0 * 0.999) return factor * power;
    return 10.0 * power;
}

std::string colour_of_tissue(const std::vector<std::string>& names, std::size_t tissue) {
    return text::tissue_colour(names[tissue], tissue).hex();
}

std::string report_data_json(const RunSummary& summary, const DrawnRun& run, const RecordedProcedure& procedure) {
    Json tissues = Json::array();
    for (std::size_t i = 0; i < summary.tissues.size(); ++i)
        tissues.push_back({{"name", summary.tissues[i]}, {"colour", colour_of_tissue(summary.tissues, i)}});
    const std::vector<TickRow> drawn = run.plotted();

    const Json data{{"tissues", std::move(tissues)},
                    {"rows", rows_json(drawn)},
                    {"steps", steps_json(summary, run, procedure, drawn)},
                    {"moments", moments_json(summary)},
                    {"signals", signals_json(summary.signals, drawn)},
                    {"events", events_json(run.events())},
                    {"mesh", mesh_json(run.bone(), direction_of_view(run.deepest()))},
                    {"zones", zones_json(summary, run.bone())},
                    {"approaches", approaches_json(summary, run.bone())}};
    const std::string text = text::printable_json(data.dump(-1, ' ', false, Json::error_handler_t::replace));

    // "</script>" or "<!--" in a name must not end the element. In JSON, "<" occurs only within a string.
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

}  // namespace kerf::session
