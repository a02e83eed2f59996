// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/run_metrics.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/plugin/unit.h"
#include "documents/known_metrics.h"
#include "kerf/units.hpp"
#include "run/verdict/screw_grade.h"
#include "text/quantity.h"

namespace kerf::run {

namespace {

using namespace literals;

/// Adds the rows of one step.
class StepRows {
public:
    StepRows(const StepState& state, double spacing, std::vector<session::MetricRow>& rows)
        : state_(&state), spacing_(spacing), rows_(&rows) {}

    session::MetricRow& row(const std::string& name, double value, const char* unit, double per_unit,
                            std::string status, std::string help) {
        session::MetricRow& added = rows_->emplace_back();
        added.id = state_->step->id + "." + name;
        added.scope = state_->step->id;
        added.value = value;
        added.unit = unit;
        added.per_unit = per_unit;
        added.status = std::move(status);
        added.help = std::move(help);
        return added;
    }
    session::MetricRow& length(const std::string& name, double value, double uncertainty, std::string status,
                               std::string help) {
        session::MetricRow& added = row(name, value, "mm", 1e-3, std::move(status), std::move(help));
        added.uncertainty = uncertainty;
        return added;
    }
    [[nodiscard]] double spacing() const noexcept { return spacing_; }
    [[nodiscard]] double half_voxel() const noexcept { return 0.5 * spacing_; }
    /// Returns the uncertainty of a wall: the field resolves it to a twentieth of a voxel [m].
    [[nodiscard]] double sharp() const noexcept { return 0.05 * spacing_; }
    /// Returns the status of the limit on a quantity; "info" without one.
    [[nodiscard]] const char* status_of(const char* quantity, double diameter = 0.0) const {
        for (const auto& limit : state_->limits)
            if (limit.limit->quantity == quantity && limit.limit->diameter == diameter)
                return limit.broken_at ? "broken" : limit.is_seen ? "ok" : "not measured";
        return "info";
    }

private:
    const StepState* state_;
    double spacing_;
    std::vector<session::MetricRow>* rows_;
};

/// Returns the status of the limits on a quantity that `is_selected` selects; "info" without one.
template <class IsSelected>
const char* status_of_limits(const StepState& state, IsSelected&& is_selected) {
    const char* status = "info";
    for (const LimitState& limit : state.limits)
        if (is_selected(*limit.limit) && (limit.broken_at || status == std::string_view("info")))
            status = limit.broken_at ? "broken" : "ok";
    return status;
}

void add_clearances(const StepState& state, StepRows& rows) {
    std::vector<std::string> zones;
    for (const auto& limit : state.limits) {
        const std::string& zone = limit.limit->zone;
        // Several limits on one zone had the same values.
        if (limit.limit->quantity != "clearance" || !limit.is_seen ||
            std::find(zones.begin(), zones.end(), zone) != zones.end())
            continue;
        zones.push_back(zone);
        rows.length("clearance." + zone, limit.worst, rows.half_voxel(),
                    status_of_limits(state, [&](const documents::Limit& one) { return one.zone == zone; }),
                    "Least distance of the running tool's cutting region to the zone; negative inside.");
    }
}

/// Adds the limits on one number of each tick. Several limits on one number had the same values.
void add_loads(const StepState& state, StepRows& rows) {
    struct Load {
        const char *quantity, *name, *unit;
        double per_unit;
        const char* help;
    };
    constexpr Load loads[] = {
        {"thrust", "thrust", "N", 1.0, "Greatest thrust of the running tool."},
        {"torque", "torque", "N m", 1.0, "Greatest torque of the bone on the tool about its shaft, either way."},
        {"lateral_force", "lateral-force", "N", 1.0, "Greatest force of the bone on the tool across its shaft."},
        {"speed", "speed", "mm/s", 1e-3, "Greatest speed of the tip while the tool ran in bone, averaged over 20 ms."},
        {"duration", "duration", "s", 1.0, "Time from the start of the step to its end, or to the end of the run."},
    };
    for (const Load& load : loads) {
        const auto is_on_it = [&](const documents::Limit& limit) { return limit.quantity == load.quantity; };
        const auto first = std::find_if(state.limits.begin(), state.limits.end(), [&](const LimitState& limit) {
            return is_on_it(*limit.limit) && limit.is_seen;
        });
        if (first != state.limits.end())
            rows.row(load.name, first->worst, load.unit, load.per_unit, status_of_limits(state, is_on_it), load.help);
    }
}

void add_removed_volume(const StepState& state, StepRows& rows) {
    const auto is_on_it = [](const auto& asked) { return asked.quantity == "removed_volume"; };
    if (std::any_of(state.step->goals.begin(), state.step->goals.end(), is_on_it) ||
        std::any_of(state.step->limits.begin(), state.step->limits.end(), is_on_it))
        rows.row("removed-volume", state.removed, "mm3", 1e-9, status_of_limits(state, is_on_it),
                 "Bone removed in this step; while the step lasts, counted every 50 ms.");
}

/// Adds the maximum of a signal for a goal at least, or a limit at most, and the minimum for the opposite.
void add_signals(const StepState& state, StepRows& rows) {
    for (const SignalState& signal : state.signals) {
        if (!signal.is_seen) continue;
        const documents::NamedSignal& named = *signal.signal;
        const auto add = [&](double value, std::optional<double> documents::Bound::*goal_end,
                             std::optional<double> documents::Bound::*limit_end, const char* suffix, const char* help) {
            const auto is_limit = [&](const documents::Limit& limit) {
                return limit.signal.id == named.id && limit.bound.*limit_end;
            };
            const bool is_goal = std::any_of(
                state.step->goals.begin(), state.step->goals.end(),
                [&](const documents::Goal& goal) { return goal.signal.id == named.id && goal.bound.*goal_end; });
            if (is_goal || std::any_of(state.step->limits.begin(), state.step->limits.end(), is_limit))
                rows.row("signal." + named.id + suffix, value, named.unit.c_str(),
                         parse_unit(named.unit).value_or(Unit{}).factor, status_of_limits(state, is_limit), help);
        };
        add(signal.greatest, &documents::Bound::at_least, &documents::Bound::at_most, "",
            "Greatest value of this signal in the step.");
        add(signal.least, &documents::Bound::at_most, &documents::Bound::at_least, ".least",
            "Least value of this signal in the step.");
    }
}

/// Adds poses and distances at the end of the step.
void add_alignment(const StepState& state, StepRows& rows) {
    if (state.reduction && state.step->is_with_piece()) {
        rows.length("reduction-offset", state.reduction->offset, -1.0, rows.status_of("reduction_offset"),
                    "Distance of the fragment from its place in the whole bone, at the fracture.");
        rows.row("reduction-angle", state.reduction->angle, "deg", 1.0_deg, rows.status_of("reduction_angle"),
                 "By how much the fragment is turned from there.");
    }
    for (const LimitState& limit : state.limits) {
        const char* status = limit.broken_at ? "broken" : "ok";
        if (!limit.is_seen) continue;
        if (limit.limit->quantity == "axes_angle")
            rows.row("axes-angle." + limit.limit->landmark, limit.worst, "deg", 1.0_deg, status,
                     "Between the axes " + limit.limit->landmark + " and " + limit.limit->other + ".");
        if (limit.limit->quantity == "tip_apex")
            rows.length("tip-apex", limit.worst, rows.half_voxel(), status,
                        "Distance of the tip from " + limit.limit->landmark +
                            " as seen from the front, plus the same in the side view that shows the neck.");
    }
}

/// Returns the explanation of a measure, for people.
std::string help_of(const documents::Measure& measure) {
    switch (measure.kind) {
        case documents::Measure::Kind::angle:
            return "Angle between " + measure.of + " and " + measure.to +
                   (measure.in.empty() ? "" : ", as seen in " + measure.in) + ".";
        case documents::Measure::Kind::distance:
            return "Distance between " + measure.of + " and " + measure.to + ".";
        case documents::Measure::Kind::thickness:
            return "Thickness of the bone at " + measure.of + ", along " + measure.to + ".";
        case documents::Measure::Kind::surface_distance:
            return "Distance of " + measure.of + " to the bone's surface; negative inside.";
        case documents::Measure::Kind::roughness:
            return "Unevenness of the border at " + measure.of + ": root mean square.";
        case documents::Measure::Kind::difference:
            return "By how much " + measure.of + " is larger than " + measure.to + ".";
    }
    return {};
}

session::MetricRow measure_row(const documents::Measure& measure, const documents::MeasureReading& reading,
                               const std::string& scope) {
    session::MetricRow row;
    row.scope = scope;
    row.value = reading.value.value_or(0.0);
    row.unit = measure.unit();
    row.per_unit = measure.is_angle() ? 1.0_deg : 1.0_mm;
    row.uncertainty = reading.uncertainty;
    return row;
}

/// Adds the measures of the bone at the end of the step, or as last measured.
void add_measures(const StepState& state, const documents::Procedure& procedure,
                  std::vector<session::MetricRow>& rows) {
    for (std::size_t m = 0; m < procedure.measures.size() && m < state.measures.size(); ++m) {
        const documents::Measure& measure = procedure.measures[m];
        if (!state.measures[m].value) continue;
        session::MetricRow row = measure_row(measure, state.measures[m], state.step->id);
        row.id = state.step->id + ".measure." + measure.id;
        row.status =
            status_of_limits(state, [&](const documents::Limit& limit) { return limit.measure == measure.id; });
        row.help = help_of(measure);
        rows.push_back(std::move(row));
    }
}

/// Adds the measures of the whole run: before the first cut, and at the end of the last measured step.
void add_measures_of_run(const StepMonitor& monitor, const Scene& scene, std::vector<session::MetricRow>& rows) {
    for (std::size_t m = 0; m < scene.measured_before.size(); ++m) {
        const documents::Measure& measure = scene.procedure.measures[m];
        const auto add = [&](const documents::MeasureReading& reading, const char* when, const std::string& status) {
            session::MetricRow row = measure_row(measure, reading, "run");
            row.id = "measure." + measure.id + "." + when;
            row.status = status;
            row.help = help_of(measure);
            rows.push_back(std::move(row));
        };
        add(scene.measured_before[m], "before", "info");
        const auto& steps = monitor.steps();
        const auto last = std::find_if(steps.rbegin(), steps.rend(), [&](const StepState& state) {
            return m < state.measures.size() && state.measures[m].value;
        });
        if (last == steps.rend()) continue;
        add(last->measures[m], "after",
            status_of_limits(*last, [&](const documents::Limit& limit) { return limit.measure == measure.id; }));
    }
}

/// Adds metrics that are reported only for a goal or limit.
void add_demanded(const StepState& state, StepRows& rows) {
    add_loads(state, rows);
    add_removed_volume(state, rows);
    add_signals(state, rows);
    add_alignment(state, rows);
}

void add_wall(const StepState& state, StepRows& rows) {
    if (state.wall) {
        rows.row("plane-angle", state.wall->angle, "deg", 1.0_deg, rows.status_of("plane_angle"),
                 "Between the plane of least squares through the wall that the cut left and the planned plane.");
        rows.length("plane-offset", state.wall->offset, rows.sharp(), rows.status_of("plane_offset"),
                    "Of the wall's middle from where a blade in the planned plane would leave it.");
        rows.length("flatness", state.wall->flatness, 2.0 * rows.sharp(), rows.status_of("flatness"),
                    "Between two planes along that of least squares that hold the wall.");
    }
    rows.row("removed", state.removed, "mm3", 1e-9, "info", "Bone removed in this step.");
}

void add_advance(const TipProgress& advance, StepRows& rows) {
    rows.row("time-in-air", advance.in_air, "s", 1.0, rows.status_of("time_in_air"),
             "How long the tip itself had no bone in front of it while it went on, after it had met bone.");
    rows.length("depth-in-air", advance.depth_in_air, rows.half_voxel(), "info", "Depth that it gained so.");
    std::string_view status = rows.status_of("plunge");
    if (status == "not measured") status = "ok";  // it never left the bone
    if (advance.plunge <= 0.0 && advance.hand_plunge <= 0.0 && status == "info") return;
    rows.length("plunge", advance.plunge, rows.half_voxel(), std::string(status),
                "The farthest that the tip went on behind a face through which it left the bone.");
    rows.length("plunge.hand", advance.hand_plunge, -1.0, "info", "The farthest that the hand moved on meanwhile.");
}

void add_sides(const std::string& name, const bone::Breach& breach, const AxisFrame& frame, StepRows& rows) {
    const bool knows_sides = frame.medial != Vec3{};
    constexpr std::array sides{"medial", "lateral", "cranial", "caudal"};
    for (std::size_t side = 0; knows_sides && side < sides.size(); ++side)
        if (breach.towards[side] > 0.0)
            rows.length(name + "." + sides[side], breach.towards[side], rows.half_voxel(), "info",
                        "The same on this side.");
}

/// @param is_one   one of several, which are distinguished by their diameters
void add_breach(double diameter, const bone::Breach& breach, bool is_one, const AxisFrame& frame, StepRows& rows) {
    const std::string name = documents::breach_name(diameter, is_one);
    rows.length(name, breach.worst(), rows.half_voxel(), rows.status_of("breach", diameter),
                "How far a cylinder of " + text::quantity_text(diameter, "mm") + " along the hole leaves the bone.");
    add_sides(name, breach, frame, rows);
}

/// Returns the relative uncertainty of a blind hole's volume at this width in voxels [–]. Measured: up to 6.4 % at
/// 4 voxels and 1.1 % at 6.4 voxels (docs/limits.md).
double volume_uncertainty(double voxels) { return voxels < 6.0 ? 0.07 : 0.015; }

/// Rows of offsets from the planned axis.
class OffsetRows {
public:
    OffsetRows(const char* what, StepRows& rows) : what_(what), rows_(&rows) {}

    void add(const char* name, const char* quantity, const std::optional<double>& value, const std::string& where,
             int revision = 1) {
        if (!value) return;
        rows_
            ->length(name, *value, rows_->sharp(), rows_->status_of(quantity),
                     std::string("Distance of ") + what_ + " from the planned axis " + where)
            .revision = revision;
    }

private:
    const char* what_;
    StepRows* rows_;
};

void add_angle(const bone::DrilledHole& hole, const char* line, StepRows& rows) {
    if (hole.angle)
        rows.row("hole-angle", *hole.angle, "deg", 1.0_deg, rows.status_of("hole_angle"),
                 std::string("Between ") + line + " and the planned axis.");
}

constexpr const char* at_waist = "at the waist of the bone around the axis; where there is none, at the entry.";

/// @param width   [m] of the drill
void add_drilled(const bone::DrilledHole& hole, double width, StepRows& rows) {
    add_angle(hole, "the line of least squares through the hole's middles", rows);
    OffsetRows offsets("the hole's middle", rows);
    // Revision 1 was the position of the tip at first contact.
    offsets.add("entry-offset", "entry_offset", hole.entry_offset, "one diameter behind its first whole circle.", 2);
    offsets.add("narrowest-offset", "narrowest_offset", hole.narrowest_offset, at_waist);
    offsets.add("end-offset", "end_offset", hole.end_offset, "where its last whole circle is.");
    session::MetricRow& excess =
        rows.row("excess-removal", hole.ideal > 0.0 ? hole.drilled / hole.ideal - 1.0 : 0.0, "%", 0.01,
                 rows.status_of("excess_removal"),
                 "Bone removed beyond what the same tool takes on the planned axis, of the bone that was left for it.");
    // That of the whole hole, of the bone that was left.
    excess.uncertainty =
        volume_uncertainty(width / rows.spacing()) * (hole.ideal > 0.0 ? hole.whole / hole.ideal : 1.0);
    excess.revision = 2;  // revision 1 took bone that was drilled before as left
}

void add_screw(const InsertedScrew& screw, const bone::DrilledHole& axis, const AxisFrame& frame, StepRows& rows) {
    add_angle(axis, "the axis of the screw", rows);
    OffsetRows offsets("the screw's axis", rows);
    offsets.add("entry-offset", "entry_offset", axis.entry_offset, "at the entry.");
    offsets.add("narrowest-offset", "narrowest_offset", axis.narrowest_offset, at_waist);
    offsets.add("end-offset", "end_offset", axis.end_offset, "at its tip.");
    if (screw.hole_offset)
        rows.length("hole-offset", *screw.hole_offset, rows.sharp(), "info",
                    "Distance of the screw's axis from the axis of the implant's hole, in the middle of the metal.");
    if (screw.hole_angle)
        rows.row("hole-axis-angle", *screw.hole_angle, "deg", 1.0_deg, "info",
                 "Between the axis of the screw and that of the implant's hole.");
    const std::string how_far =
        "How far the screw's thread, " + text::quantity_text(screw.diameter, "mm") + " wide, leaves the bone";
    const bool is_in_vertebra = !screw.heary_grade.empty();  // both grades are defined for screws in pedicles
    const std::string name = is_in_vertebra ? "gertzbein-robbins" : "thread-outside";
    if (is_in_vertebra)
        rows.length(name, screw.breach.worst(), rows.half_voxel(),
                    "grade " + gertzbein_robbins(screw.least, screw.most), how_far + ", and its grade by it.");
    else
        rows.length(name, screw.breach.worst(), rows.half_voxel(), "info", how_far + ".");
    add_sides(name, screw.breach, frame, rows);
    if (is_in_vertebra)
        rows.length("heary", screw.breach.worst(), rows.half_voxel(), "grade " + screw.heary_grade,
                    "The same, and its grade by where it leaves the bone.");
}

void add_hole(const HoleResult& result, const AxisFrame& frame, double width, StepRows& rows) {
    if (!result.hole) return;
    if (result.screw)
        add_screw(*result.screw, *result.hole, frame, rows);
    else
        add_drilled(*result.hole, width, rows);
    for (const auto& [diameter, breach] : result.breaches)
        add_breach(diameter, breach, result.breaches.size() > 1, frame, rows);
}

}  // namespace

namespace {

/// Returns whether an earlier step has drilled along the same axis: then there is often no bone ahead of the tip.
bool is_in_a_hole(const Scene& scene, std::size_t step) {
    for (std::size_t before = 0; before < step; ++before)
        if (scene.procedure.steps[before].axis == scene.procedure.steps[step].axis &&
            !scene.tool(before).outline.cutting.is_prism() && scene.procedure.steps[before].cuts())
            return true;
    return false;
}

}  // namespace

std::vector<session::MetricRow> metrics_of(const StepMonitor& monitor, const Scene& scene) {
    std::vector<session::MetricRow> all;
    for (std::size_t s = 0; s < monitor.steps().size(); ++s) {
        const StepState& state = monitor.steps()[s];
        if (!state.start) continue;
        StepRows rows(state, scene.procedure.spacing, all);
        if (!state.step->cuts()) {
            rows.length("moved", state.moved, rows.half_voxel(), "info",
                        "How far the piece was from where it had been, at the step's entry.");
            add_demanded(state, rows);
            add_measures(state, scene.procedure, all);
            continue;
        }
        rows.length("depth", state.left_depth.value_or(std::max(0.0, state.deepest)), rows.half_voxel(), "info",
                    state.left_depth
                        ? "Depth of the implant's tip as it was left, along the planned axis from its entry."
                        : "Deepest that the tip was while bone resisted it, along the planned axis from "
                          "its entry.");
        if (state.has_cut_bone())  // without a cut, its aim is unknown
            rows.length("offset", state.farthest_offset, rows.half_voxel(), "info",
                        "Largest distance of the tip from the planned axis while it cut bone: how far it wandered.");
        add_clearances(state, rows);
        add_demanded(state, rows);
        if (state.drilled)
            add_hole(*state.drilled, monitor.frame(s), 2.0 * scene.tool(s).outline.cutting.largest_radius(), rows);
        if (state.step->has_depth() && state.has_cut_bone() && !is_in_a_hole(scene, s))
            add_advance(state.advance, rows);
        if (state.is_done() && monitor.frame(s).across != Vec3{}) add_wall(state, rows);
        rows.row("axis-in-bone", scene.fraction_in_bone[s], "%", 0.01, "info",
                 "Share of the planned axis behind its entry that lies in bone.");
        add_measures(state, scene.procedure, all);
    }
    add_measures_of_run(monitor, scene, all);
    return all;
}

std::vector<session::MetricRow> implant_metrics(const std::string& step, const kerf_force& law, const double* signals) {
    std::vector<session::MetricRow> rows;
    for (std::uint32_t i = 0; i < law.signal_count; ++i) {
        const kerf_signal& signal = law.signals[i];
        std::string name = signal.id;
        std::replace(name.begin(), name.end(), '_', '-');
        session::MetricRow& row = rows.emplace_back();
        row.id = step + ".left." + name;
        row.scope = step;
        row.value = signals[i];
        row.unit = signal.display_unit;
        row.per_unit = parse_unit(row.unit).value_or(Unit{}).factor;
        row.status = "info";
        row.help = "When the driver left: " + std::string(signal.help);
    }
    return rows;
}

session::MetricRow bone_kept_row(const std::string& step, double part) {
    session::MetricRow row;
    row.id = step + ".left.bone-kept";
    row.scope = step;
    row.value = part;
    row.unit = "%";
    row.per_unit = 0.01;
    row.status = "info";
    row.help =
        "Of the bone close around the implant's thread when the driver left, what is there at the end of the run.";
    return row;
}

session::MetricRow groove_row(double volume) {
    session::MetricRow row;
    row.id = "bone.grooves";
    row.scope = "run";
    row.value = volume;
    row.unit = "mm3";
    row.per_unit = 1e-9;
    row.status = "info";
    row.help = "Bone that the grooves of threads have taken. It is not counted as removed.";
    return row;
}

session::MetricRow count_row(std::string id, std::size_t count, std::string help) {
    session::MetricRow row;
    row.id = std::move(id);
    row.scope = "run";
    row.value = static_cast<double>(count);
    row.status = "info";
    row.help = std::move(help);
    return row;
}

std::vector<session::MetricRow> piece_metrics(const session::RunSummary& summary, double before, std::size_t crumbs,
                                              double crumb_volume) {
    if (summary.pieces.size() < 2 && crumbs == 0) return {};
    std::vector<session::MetricRow> rows;
    const auto row = [&](std::string id, const char* scope, double value, std::string unit, double per_unit,
                         std::string help) {
        session::MetricRow& added = rows.emplace_back();
        added.id = std::move(id);
        added.scope = scope;
        added.value = value;
        added.unit = std::move(unit);
        added.per_unit = per_unit;
        added.status = "info";
        added.help = std::move(help);
    };
    double after = summary.removed + crumb_volume;
    row("bone.pieces", "run",
        static_cast<double>(std::count_if(summary.pieces.begin(), summary.pieces.end(),
                                          [](const session::PieceRow& piece) { return !piece.is_metal; })),
        "", 1.0, "Pieces of bone at the end, without crumbs.");
    for (const session::PieceRow& piece : summary.pieces) {
        after += piece.volume;
        row((piece.is_metal ? "implant-" : "bone.piece-") + std::to_string(piece.body), "run", piece.volume, "mm3",
            1e-9, std::string("Volume of this ") + (piece.is_metal ? "implant" : "piece") + ", in " + piece.file + ".");
    }
    row("bone.crumbs", "run", static_cast<double>(crumbs), "", 1.0, "Pieces under 10 mm3: they are washed away.");
    row("bone.crumb-volume", "run", crumb_volume, "mm3", 1e-9, "Bone in them.");
    row("bone.balance", session::simulation_scope, before > 0.0 ? (after - before) / before : 0.0, "%", 0.01,
        "Pieces, implants, removed bone and crumbs together, over the bone and the implants before, less one.");
    return rows;
}

session::MetricRow port_energy_row(const PassivityGuard& guard) {
    session::MetricRow row;
    row.id = "haptics.port-energy";
    row.scope = session::simulation_scope;
    row.value = guard.min_energy();
    row.unit = "mJ";
    row.per_unit = 1e-3;
    row.status = guard.corrections() > 0 ? "corrected" : "ok";
    row.help =
        "Least balance of the energy the device exchanged with the hand; below -0.1 mJ a damper takes the excess back.";
    return row;
}

}  // namespace kerf::run
