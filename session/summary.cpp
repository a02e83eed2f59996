// SPDX-License-Identifier: Apache-2.0
#include "session/summary.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

#include "session/content_hash.h"
#include "session/exact_summary.h"
#include "session/recorder.h"
#include "text/plain_numbers.h"
#include "text/printable_lines.h"

namespace kerf::session {
namespace {

using Json = nlohmann::ordered_json;

/// Rounds to twelve digits: 0.0065 m is then 6.5 mm, not 6.499999999999999.
Json plain_number(double value) {
    if (!std::isfinite(value)) return nullptr;
    const text::PlainNumbers point;
    char text[40];
    std::snprintf(text, sizeof text, "%.12g", value);
    return std::strtod(text, nullptr);
}

Json to_json(const StepRow& step) {
    return {{"id", step.id},
            {"done", step.done},
            {"start_s", plain_number(step.start)},
            {"end_s", plain_number(step.end)},
            {"limits", step.broken_limits}};
}

Json to_json(const MetricRow& metric) {
    const bool is_uncertainty_known = metric.uncertainty >= 0.0;
    return {{"id", metric.id},
            {"revision", metric.revision},
            {"scope", metric.scope},
            {"occurrence", metric.occurrence},
            {"occurrences", metric.occurrences},
            {"value", plain_number(metric.value / metric.per_unit)},
            {"unit", metric.unit},
            {"uncertainty", is_uncertainty_known ? plain_number(metric.uncertainty / metric.per_unit) : Json(nullptr)},
            {"status", metric.status}};
}

Json to_json(const DeductionRow& deduction) {
    return {{"step", deduction.step},
            {"kind", deduction.kind},
            {"name", deduction.name},
            {"detail", deduction.detail},
            {"at_s", deduction.at ? plain_number(*deduction.at) : Json(nullptr)},
            {"loss", plain_number(deduction.loss)}};
}

Json to_json(const ClockRow::Times& times) {
    const auto in_us = [](double seconds) { return plain_number(std::round(seconds * 1e8) * 1e-2); };
    return {{"median_us", in_us(times.median)},
            {"p99_us", in_us(times.p99)},
            {"p99_9_us", in_us(times.p999)},
            {"worst_us", in_us(times.worst)}};
}

Json to_json(const ClockRow::SlowTick& tick) {
    const auto in_ms = [](double seconds) { return plain_number(std::round(seconds * 1e6) * 1e-3); };
    return {{"tick", tick.tick},
            {"lateness_ms", in_ms(tick.lateness)},
            {"response_ms", in_ms(tick.response)},
            {"compute_ms", in_ms(tick.compute)},
            {"cause", tick.cause},
            {"part", tick.part},
            {"part_ms", in_ms(tick.part_time)},
            {"page_faults", tick.page_faults}};
}

Json to_json(const ClockRow& clock) {
    Json causes = Json::object(), slowest = Json::array(), histogram = Json::array();
    for (const auto& [cause, ticks] : clock.late_causes) causes[cause] = ticks;
    for (const ClockRow::SlowTick& tick : clock.slowest) slowest.push_back(to_json(tick));
    for (const ClockRow::Class& one : clock.histogram)
        histogram.push_back(
            {{"up_to_us", plain_number(one.up_to * 1e6)}, {"lateness", one.lateness}, {"compute", one.compute}});
    return {{"period_ms", plain_number(clock.period * 1e3)},
            {"ticks", clock.ticks},
            {"late_ticks", clock.late_ticks},
            {"missed_periods", clock.missed_periods},
            {"pauses", clock.pauses},
            {"fades",
             {{"machine", clock.fades_by_machine}, {"device", clock.fades_by_device}, {"fault", clock.fades_by_fault}}},
            {"ticks_over_period", clock.over_period},
            {"lateness", to_json(clock.lateness)},
            {"compute", to_json(clock.compute)},
            {"late_causes", causes},
            {"slowest", slowest},
            {"histogram", histogram},
            {"fifo_priority", clock.priority},
            {"memory_locked", clock.is_memory_locked},
            {"load", plain_number(clock.load)},
            {"kernel", clock.kernel},
            {"refusals", clock.refusals}};
}

}  // namespace

const char* to_text(Verdict verdict) noexcept {
    switch (verdict) {
        case Verdict::pass:
            return "pass";
        case Verdict::fail:
            return "fail";
        case Verdict::incomplete:
            return "incomplete";
        case Verdict::invalid:
            return "invalid";
    }
    return "invalid";
}

std::string summary_json(const RunSummary& summary) {
    Json steps = Json::array();
    for (const StepRow& step : summary.steps) steps.push_back(to_json(step));
    Json metrics = Json::array();
    for (const MetricRow& metric : summary.metrics) metrics.push_back(to_json(metric));
    Json pieces = Json::array();
    for (const PieceRow& piece : summary.pieces)
        pieces.push_back({{"body", piece.body},
                          {"material", piece.is_metal ? "metal" : "bone"},
                          {"volume_mm3", plain_number(piece.volume * 1e9)},
                          {"file", piece.file}});
    Json deductions = Json::array();
    for (const DeductionRow& deduction : summary.deductions) deductions.push_back(to_json(deduction));
    Json versions = Json::object();
    for (const auto& [part, version] : summary.versions) versions[part] = version;

    Json document{{"schema", 1},
                  {"notice", notice_line},
                  {"procedure", summary.procedure},
                  {"verdict", to_text(summary.verdict)},
                  {"reasons", summary.reasons},
                  {"score", plain_number(summary.score)},
                  {"score_rules", summary.score_rules},
                  {"score_band", summary.score_band},
                  {"deductions", std::move(deductions)},
                  {"duration_s", plain_number(summary.duration)},
                  {"steps", std::move(steps)},
                  {"metrics", std::move(metrics)},
                  {"ticks", summary.ticks},
                  {"removed_mm3", plain_number(summary.removed * 1e9)},
                  {"pieces", std::move(pieces)},
                  {"force_scale", plain_number(summary.force_scale)},
                  {"hash", hex16(summary.hash)},
                  {"versions", std::move(versions)},
                  {"anatomy_notes", summary.anatomy_notes},
                  {"variant", summary.variant},
                  {"hand", summary.hand},
                  {"device", summary.device}};
    if (!summary.leader.empty()) document["leader"] = summary.leader;
    if (!summary.parent.empty()) document["continues"] = {{"session", summary.parent}, {"ticks", summary.parent_ticks}};
    if (!summary.leader_setup.empty()) document["leader_setup"] = summary.leader_setup;
    if (summary.exact) document["exact_surface"] = exact_summary(*summary.exact);
    if (summary.clock) document["clock"] = to_json(*summary.clock);
    return text::printable_json(document.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}

}  // namespace kerf::session
