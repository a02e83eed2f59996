// SPDX-License-Identifier: Apache-2.0
#include "app/run_result.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/procedure/quantity.h"
#include "kerf/units.hpp"

namespace kerf {

namespace {

using namespace literals;

std::string millimetres(double metres) {
    char text[32];
    const long tenths = static_cast<long>(metres * 1e4 + (metres >= 0.0 ? 0.5 : -0.5));
    std::snprintf(text, sizeof text, "%s%ld.%ld mm", tenths < 0 ? "-" : "", std::labs(tenths) / 10,
                  std::labs(tenths) % 10);
    return text;
}

std::string in_degrees(double angle) { return quantity_text(std::round(angle / 0.1_deg) * 0.1_deg, "deg"); }

/// What a limit was broken with, after its own sentence.
std::string how_far(const LimitState& limit) {
    const std::string& quantity = limit.limit->quantity;
    if (quantity == "clearance") return limit.worst < 0.0 ? " Deepest: " + millimetres(-limit.worst) + "." : "";
    if (quantity == "depth") return " Depth: " + millimetres(limit.worst) + ".";
    if (quantity == "thrust") return " Thrust: " + quantity_text(std::round(limit.worst), "N") + ".";
    if (quantity == "plane_angle") return " Angle: " + in_degrees(limit.worst) + ".";
    return (quantity == "flatness" ? " Uneven by: " : " Off by: ") + millimetres(limit.worst) + ".";
}

std::string what_was_missed(const Goal& goal, const StepState& state) {
    if (goal.quantity == "entry")
        return state.has_met_bone_still ? "the tool stood on the bone, but it was not running"
                                        : "the tool never met bone";
    if (goal.quantity == "separated") return "the bone did not come apart";
    if (goal.quantity == "held") return "the piece was never held";
    if (goal.quantity == "moved")
        return "the piece was moved " + millimetres(state.moved) + ", must be at least " +
               millimetres(*goal.bound.at_least);
    std::string text = "depth " + millimetres(std::max(0.0, state.deepest));
    if (goal.bound.at_least) text += ", must be at least " + millimetres(*goal.bound.at_least);
    if (goal.bound.at_most) text += ", must be at most " + millimetres(*goal.bound.at_most);
    return text;
}

}  // namespace

std::vector<MetricRow> metrics_of(const StepMonitor& monitor, const Scene& scene) {
    std::vector<MetricRow> rows;
    const double half_voxel = 0.5 * scene.procedure.spacing;
    for (std::size_t s = 0; s < monitor.steps().size(); ++s) {
        const StepState& state = monitor.steps()[s];
        if (!state.start) continue;
        const std::string& id = state.step->id;
        const auto length_row = [&](std::string name, double value, double uncertainty, std::string status,
                                    std::string help) {
            MetricRow row;
            row.id = id + "." + name;
            row.scope = id;
            row.value = value;
            row.unit = "mm";
            row.per_unit = 1e-3;
            row.uncertainty = uncertainty;
            row.status = std::move(status);
            row.help = std::move(help);
            rows.push_back(std::move(row));
        };
        if (!state.step->cuts()) {
            length_row("moved", state.moved, half_voxel, "info",
                       "How far the piece was from where it had been, at the step's entry.");
            continue;
        }
        length_row("depth", std::max(0.0, state.deepest), half_voxel, "info",
                   "Deepest tip position in bone, along the planned axis from its entry.");
        if (state.has_cut_bone()) {  // of one that cut nothing nobody knows how well it was aimed
            length_row("entry-offset", state.entry_offset, half_voxel, "info",
                       "Distance of the tip from the planned axis when it first cut bone.");
            length_row("offset", state.farthest_offset, half_voxel, "info",
                       "Largest distance of the tip from the planned axis while it cut bone: how far it wandered.");
        }
        for (const auto& limit : state.limits) {
            if (limit.limit->quantity != "clearance" || !limit.is_seen) continue;
            length_row("clearance." + limit.limit->zone, limit.worst, half_voxel, limit.broken_at ? "broken" : "ok",
                       "Least distance of the running tool's cutting region to the zone; negative inside.");
        }
        for (const auto& limit : state.limits)
            if (limit.limit->quantity == "thrust" && limit.is_seen) {
                MetricRow& row = rows.emplace_back();
                row.id = id + ".thrust";
                row.scope = id;
                row.value = limit.worst;
                row.unit = "N";
                row.status = limit.broken_at ? "broken" : "ok";
                row.help = "Greatest thrust of the running tool.";
            }
        if (state.is_done() && scene.frames[s].across != Vec3{}) {
            const auto status_of = [&](const char* quantity) {
                for (const auto& limit : state.limits)
                    if (limit.limit->quantity == quantity)
                        return limit.broken_at ? "broken" : limit.is_seen ? "ok" : "not measured";
                return "info";
            };
            if (state.wall) {
                // The field knows a wall to a twentieth of a voxel.
                const double sharp = 0.05 * scene.procedure.spacing;
                MetricRow& angle = rows.emplace_back();
                angle.id = id + ".plane-angle";
                angle.scope = id;
                angle.value = state.wall->angle;
                angle.unit = "deg";
                angle.per_unit = 1.0_deg;
                angle.status = status_of("plane_angle");
                angle.help =
                    "Between the plane of least squares through the wall that the cut left and the planned plane.";
                length_row("plane-offset", state.wall->offset, sharp, status_of("plane_offset"),
                           "Of the wall's middle from where a blade in the planned plane would leave it.");
                length_row("flatness", state.wall->flatness, 2.0 * sharp, status_of("flatness"),
                           "Between two planes along that of least squares that hold the wall.");
            }
            MetricRow& volume = rows.emplace_back();
            volume.id = id + ".removed";
            volume.scope = id;
            volume.value = state.removed;
            volume.unit = "mm3";
            volume.per_unit = 1e-9;
            volume.status = "info";
            volume.help = "Bone removed in this step.";
        }
        MetricRow share;
        share.id = id + ".axis-in-bone";
        share.scope = id;
        share.value = scene.share_in_bone[s];
        share.unit = "%";
        share.per_unit = 0.01;
        share.status = "info";
        share.help = "Share of the planned axis behind its entry that lies in bone.";
        rows.push_back(std::move(share));
    }
    return rows;
}

std::vector<MetricRow> piece_metrics(const RunSummary& summary, double before, std::size_t crumbs,
                                     double crumb_volume) {
    if (summary.pieces.size() < 2 && crumbs == 0) return {};
    std::vector<MetricRow> rows;
    const auto row = [&](std::string id, double value, std::string unit, double per_unit, std::string help) {
        MetricRow& added = rows.emplace_back();
        added.id = std::move(id);
        added.scope = "run";
        added.value = value;
        added.unit = std::move(unit);
        added.per_unit = per_unit;
        added.status = "info";
        added.help = std::move(help);
    };
    double after = summary.removed + crumb_volume;
    row("bone.pieces", static_cast<double>(summary.pieces.size()), "", 1.0,
        "Pieces of bone at the end, without crumbs.");
    for (const PieceRow& piece : summary.pieces) {
        after += piece.volume;
        row("bone.piece-" + std::to_string(piece.body), piece.volume, "mm3", 1e-9,
            "Volume of this piece, in " + piece.file + ".");
    }
    row("bone.crumbs", static_cast<double>(crumbs), "", 1.0, "Pieces under 10 mm3: they are washed away.");
    row("bone.crumb-volume", crumb_volume, "mm3", 1e-9, "Bone in them.");
    row("bone.balance", before > 0.0 ? (after - before) / before : 0.0, "%", 0.01,
        "Pieces, removed bone and crumbs together, over the bone before, less one.");
    return rows;
}

MetricRow port_energy_row(const PassivityGuard& guard) {
    MetricRow row;
    row.id = "haptics.port-energy";
    row.scope = "haptics";
    row.value = guard.least_energy();
    row.unit = "mJ";
    row.per_unit = 1e-3;
    row.status = guard.corrections() > 0 ? "corrected" : "ok";
    row.help =
        "Least balance of the energy the device exchanged with the hand; below -0.1 mJ a damper takes the excess back.";
    return row;
}

void judge(const StepMonitor& monitor, RunEnd end, double duration, double time_limit, RunSummary& summary) {
    int demands = 0, met = 0;
    bool is_broken = false, is_missing = false;
    for (const auto& state : monitor.steps()) {
        StepRow row{state.step->id,
                    state.step->title,
                    state.is_done(),
                    state.start.value_or(0.0),
                    state.end.value_or(duration),
                    {}};
        for (const auto& limit : state.limits) {
            ++demands;
            if (state.is_done() && limit.limit->is_of_wall() && !limit.is_seen) {
                is_missing = true;
                summary.reasons.push_back("Step `" + state.step->id +
                                          "`: its cut left no wall near the planned plane to measure " +
                                          limit.limit->quantity + " on.");
                continue;
            }
            if (!limit.broken_at) {
                ++met;
                continue;
            }
            is_broken = true;
            row.broken_limits.push_back(limit.limit->name());
            summary.reasons.push_back("Step `" + state.step->id + "`: " + limit.limit->reason + how_far(limit));
        }
        for (std::size_t g = 0; g < state.goal_done.size(); ++g) {
            ++demands;
            met += state.goal_done[g];
            if (state.goal_done[g]) continue;
            is_missing = true;
            summary.reasons.push_back("Step `" + state.step->id + "`: " + what_was_missed(state.step->goals[g], state) +
                                      ".");
        }
        if (!state.is_done() && !is_missing && !is_broken) {
            is_missing = true;
            summary.reasons.push_back("Step `" + state.step->id + "`: the tool was not withdrawn.");
        }
        summary.steps.push_back(std::move(row));
    }
    if (end == RunEnd::time_over)
        summary.reasons.push_back("The run reached the procedure's `time_limit:` of " + quantity_text(time_limit, "s") +
                                  ".");
    if (end == RunEnd::interrupted) summary.reasons.insert(summary.reasons.begin(), "The run was interrupted.");
    if (end == RunEnd::unrecorded)
        summary.reasons.insert(summary.reasons.begin(), "The run ended early: it could not be recorded any more.");
    is_missing = is_missing || end == RunEnd::interrupted || end == RunEnd::unrecorded;
    summary.verdict = end == RunEnd::fault ? Verdict::invalid
                      : is_broken          ? Verdict::fail
                      : is_missing         ? Verdict::incomplete
                                           : Verdict::pass;
    if (end == RunEnd::fault)
        summary.reasons.insert(summary.reasons.begin(), "The force law or the solve failed; force was released.");
    summary.score = demands > 0 ? 100.0 * met / demands : 100.0;
}

bool ended_as_expected(const Rehearsal& rehearsal, const StepMonitor& monitor, Verdict verdict) {
    if (rehearsal.expect == "pass") return verdict == Verdict::pass;
    if (rehearsal.expect == "incomplete") return verdict == Verdict::incomplete;
    if (verdict != Verdict::fail) return false;
    bool is_named = false;
    for (const auto& state : monitor.steps()) {
        for (const auto& limit : state.limits) {
            if (!limit.broken_at) continue;
            const bool is_the_one = rehearsal.expect_limit == limit.limit->name() &&
                                    (rehearsal.expect_step.empty() || rehearsal.expect_step == state.step->id);
            if (!is_the_one) return false;
            is_named = true;
        }
        // "For that alone": everything else went well.
        if (std::find(state.goal_done.begin(), state.goal_done.end(), false) != state.goal_done.end()) return false;
    }
    return is_named;
}

}  // namespace kerf
