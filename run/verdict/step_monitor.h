// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bone/measure/cut_wall.h"
#include "bone/measure/drilled_hole.h"
#include "core/field/cut/tool_solid.h"
#include "core/haptics/loop/owners.h"
#include "documents/anatomy.h"
#include "documents/procedure.h"
#include "run/verdict/reduction.h"

/// Judges goals and limits of the steps in file order, tick by tick. A pure function of its observations.
namespace kerf::run {

/// The frame of a step: its axis, with the origin at the first bone along it.
struct AxisFrame {
    Vec3 entry{};    ///< LPS [m]
    Vec3 along{};    ///< unit, into the bone
    Vec3 medial{};   ///< unit, perpendicular to the axis, towards the landmark `midline`; zero without it
    Vec3 across{};   ///< unit, perpendicular to the axis, along the normal of the step's plane; zero without one
    Vec3 inwards{};  ///< unit, into the bone, perpendicular to its surface at the entry; zero: same as `along`
    std::optional<double> plate{};  ///< [m] depth of the middle of the metal around an implant's hole; none: a landmark

    [[nodiscard]] double depth_of(Vec3 point) const noexcept { return dot(point - entry, along); }
    /// Returns the direction in the plane perpendicular to the axis: the tool's x axis.
    [[nodiscard]] Vec3 aside() const noexcept { return cross(across, along); }
    /// Returns the side to which a hand misses the plan: off the step's plane, or towards the midline, or any.
    [[nodiscard]] Vec3 off_plan() const noexcept;
    /// Returns the tool pose at a waypoint: tip there, +z along the axis and, with a plane, y along its normal.
    [[nodiscard]] Pose pose_at(const documents::Waypoint& waypoint) const noexcept;
};
/// Returns the frame of an axis. `plane` may be null.
[[nodiscard]] AxisFrame axis_frame(const documents::LandmarkAxis& axis, double entry_along_axis,
                                   const documents::Anatomy& anatomy,
                                   const documents::LandmarkPlane* plane = nullptr) noexcept;

/// Returns the distance of a solid's outline from a zone [m]; negative inside. Samples rings along the outline.
/// @param closest   set to that point of the outline, in the frame of the zone; may be null
[[nodiscard]] double clearance(const ToolSolid& solid, const Pose& world_from_tool, const documents::Zone& zone,
                               Vec3* closest = nullptr) noexcept;

/// The state of the run in one tick.
struct Observation {
    double time = 0.0;  ///< [s]
    Pose world_from_tool = identity_pose();
    bool is_running = false;                  ///< the tool removes the bone that it sweeps
    bool is_resisted = false;                 ///< bone resists it
    double thrust = 0.0;                      ///< [N] of the bone on the tool, against its feed
    std::span<const Pose> world_from_body{};  ///< for each body; empty: one body, not moved
    int held = -1;                            ///< the body in the tool's grip; −1: none
    bool is_bone_ahead = true;                ///< present bone ahead of the tip
    double tip_inside = 0.0;                  ///< [m] depth of the tip below the surface of the uncut bone
    Vec3 handle{};                            ///< [m] position that the device reported, world frame
    double torque = 0.0;                      ///< [N·m] of the bone on the tool about its shaft, with its sign
    double lateral_force = 0.0;               ///< [N] of the bone on the tool, across its shaft
    double removed = 0.0;                     ///< [m³] in this step, at the last count
    std::span<const double> signals{};        ///< of the tool's law, SI, in declared order
};

/// Progress of the tip without bone ahead of it.
struct TipProgress {
    double front = 0.0;         ///< [m] maximum depth of the tip, along the axis
    bool has_met_bone = false;  ///< bone was ahead of the tip itself, not only of a cutting edge
    double in_air = 0.0;        ///< [s] of progress at the front without bone ahead, after that
    double depth_in_air = 0.0;  ///< [m] gained in that time
    double plunge = 0.0;        ///< [m] maximum distance beyond a face through which it left the bone
    double hand_plunge = 0.0;   ///< [m] travel of the hand in that time, along the axis

    bool is_inside = false;                       ///< it was inside bone after the last face
    std::optional<double> left_at, hand_left_at;  ///< [m] along the axis, where it last left the bone
};

/// The speed of the tip in bone, averaged over 20 ticks: a tip that breaks through or chatters jumps within single
/// ticks.
class TipSpeed {
public:
    static constexpr std::size_t ticks = 20;

    /// Adds a tick of `dt` [s]. `tip` is its present position, body frame [m].
    void show(Vec3 tip, bool is_in_bone, double dt) noexcept;
    /// Returns the average speed [m/s].
    [[nodiscard]] double value() const noexcept { return value_; }

private:
    std::array<Vec3, ticks> moved_{};  ///< [m] in each tick; zero in air
    std::size_t next_ = 0;
    std::optional<Vec3> before_;
    double value_ = 0.0;
};

/// A screw that a step has left in bone.
struct InsertedScrew {
    double diameter = 0.0;           ///< [m] over its thread
    bone::Breach breach{};           ///< of its thread
    double least = 0.0, most = 0.0;  ///< [m] bounds of the breach
    std::string heary_grade{};  ///< its grade by the location of the breach [heary-2004]; two if half a voxel decides
    std::optional<double> hole_offset{};  ///< [m] from the axis of the implant's hole, in the middle of the metal
    std::optional<double> hole_angle{};   ///< [rad] between both axes
};

/// The hole that a step drilled, or its inserted screw.
struct HoleResult {
    std::optional<bone::DrilledHole> hole;                  ///< none: no section is a whole circle
    std::optional<InsertedScrew> screw{};                   ///< its axis is the axis of `hole`
    std::vector<std::pair<double, bone::Breach>> breaches;  ///< diameter [m] of each cylinder that a limit names
};

/// Range of a signal that a goal or limit of the step names.
struct SignalState {
    const documents::NamedSignal* signal = nullptr;
    double least = 0.0, greatest = 0.0;  ///< SI, over the ticks of the step
    double last = 0.0;                   ///< SI, in the last of them
    bool is_seen = false;
};

/// Where a tool's outline was closest to a zone.
struct ClosestPoint {
    Vec3 at{};          ///< [m] frame of the body that the zone moves with
    double time = 0.0;  ///< [s]
};

struct LimitState {
    const documents::Limit* limit = nullptr;
    double worst = 0.0;  ///< the value closest to, or farthest beyond, the bound
    bool is_seen = false;
    std::optional<double> broken_at;        ///< [s]
    std::optional<ClosestPoint> closest{};  ///< of a clearance, at `worst`
};

struct StepState {
    const documents::Step* step = nullptr;
    std::vector<bool> goal_done;
    std::vector<LimitState> limits;
    std::optional<double> start, end;  ///< [s]
    double deepest = -1.0;             ///< [m] of the tip in bone; negative until it has cut some
    double farthest_offset = 0.0;      ///< [m] of the tip from the axis while it cut bone
    bool has_met_bone_still = false;   ///< it touched bone without running
    TipProgress advance;               ///< while it cut
    TipSpeed tip_speed;
    std::optional<bone::CutWall> wall;   ///< of its cut, measured at its end
    std::optional<HoleResult> drilled;   ///< its hole, measured at its end
    std::optional<Reduction> reduction;  ///< of a fracture, at the end of the step
    double removed = 0.0;                ///< [m³] in this step
    std::vector<SignalState> signals;    ///< each signal that the step names, once
    std::vector<bool> was_within_bound;  ///< for each goal on a signal: the signal was within its bound in some tick
    std::vector<documents::MeasureReading>
        measures{};  ///< of the procedure, as last measured in this step; empty: not yet

    bool is_released_at_end = false;   ///< its tool stays in the bone
    bool has_held = false;             ///< its tool has held the body of the step
    std::string lost_hold{};           ///< why its implant is no longer held as it was left; empty: it is
    std::optional<double> left_depth;  ///< [m] of the tip of an implant, as the hand left it
    double moved = 0.0;                ///< [m] maximum distance of the bone at the entry from its pose at the start
    std::size_t bodies_before = 0;     ///< its goal `separated` needs more

    [[nodiscard]] bool has_cut_bone() const noexcept { return deepest >= 0.0; }
    [[nodiscard]] bool has_reached_all() const noexcept {
        return std::all_of(goal_done.begin(), goal_done.end(), [](bool done) { return done; });
    }
    [[nodiscard]] bool is_done() const noexcept { return end.has_value(); }
    /// Returns whether the hand has done anything: cut bone, or held the piece.
    [[nodiscard]] bool has_begun() const noexcept { return has_cut_bone() || has_held; }
    /// Returns the value that a goal compares with its bound [SI]: of an implant as it was left, otherwise the most
    /// that was reached. Nothing for a goal that is an event or a measure.
    [[nodiscard]] std::optional<double> value_of_goal(std::size_t goal) const noexcept;
};

class StepMonitor {
public:
    /// Pre: procedure and anatomy outlive this object. `frames`: one per step.
    StepMonitor(const documents::Procedure& procedure, const documents::Anatomy& anatomy,
                std::vector<AxisFrame> frames);

    /// Sets that the tool of a step is an implant: the step ends when it is released, not when it is retracted.
    void ends_with_release(std::size_t step) { steps_[step].is_released_at_end = true; }

    /// Judges what a run leaves that ends within a step.
    void end_run(double time);
    /// Takes away the goals of an implant that is no longer held as it was left, for this reason.
    void lose_goals(std::size_t step, std::string why);

    /// Observes one tick with a tool whose cutting part is `cutting`.
    void observe(const Observation& now, const ToolSolid& cutting);
    /// Passes one tick in which the tool of the step is not yet in hand: it is not judged.
    void wait(double time) {
        news_.clear();
        before_ = time;
    }
    /// Judges the cut of the step that ended in the last tick: its wall, if one was found, and the bone `removed` in it
    /// [m³].
    void judge_cut(std::size_t step, const std::optional<bone::CutWall>& wall, double removed, double time);
    /// Judges the hole that the step left.
    void judge_hole(std::size_t step, HoleResult drilled, double time);
    /// Returns whether a goal on a measure needs the next measurement: the tool has left the bone since the last one.
    [[nodiscard]] bool needs_measures() const noexcept { return needs_measures_; }
    /// Passes the procedure's measures, in their order, to the running step.
    void show_measures(std::vector<documents::MeasureReading> measures);
    /// Judges the measures at the end of the step.
    void judge_measures(std::size_t step, std::vector<documents::MeasureReading> measures, double time);
    /// Adds an event that the tool's law reported in this tick.
    void report(const std::string& event, double time);
    /// Releases an implant: the step ends with the next tick. Returns the reason if it cannot, else an empty text.
    [[nodiscard]] std::string release();
    /// Sets the axis of a step, such as the axis of an inserted implant's hole.
    void set_frame(std::size_t step, const AxisFrame& frame) { frames_[step] = frame; }
    /// Sets the bodies with which zones and steps move.
    void set_owners(Owners owners) { owners_ = std::move(owners); }
    [[nodiscard]] const Owners& owners() const noexcept { return owners_; }

    [[nodiscard]] const std::vector<StepState>& steps() const noexcept { return steps_; }
    [[nodiscard]] const std::vector<documents::Measure>& measures() const noexcept { return *measures_; }
    /// Returns the index of the running step; the number of steps if all are done.
    [[nodiscard]] std::size_t current() const noexcept { return current_; }
    [[nodiscard]] const AxisFrame& frame(std::size_t step) const noexcept { return frames_[step]; }
    /// Returns the goals reached and limits broken in the last tick, as text for the event list.
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& new_events() const noexcept { return news_; }

private:
    /// Returns the number of bodies that the goal `separated` of the running step does not count: those of the scene,
    /// or all that there are if an earlier step has had that goal.
    [[nodiscard]] std::size_t bodies_parted_before(const Observation& now) const noexcept;
    [[nodiscard]] bool is_reached(std::size_t goal, const StepState& state, const Observation& now) const noexcept;
    /// Returns the value of a limit in this tick; nothing if the tick has none.
    [[nodiscard]] std::optional<double> measured(const LimitState& limit, const StepState& state,
                                                 const Observation& now, double depth, const ToolSolid& cutting) const;
    [[nodiscard]] std::optional<double> clearance_to(const LimitState& limit, const Observation& now,
                                                     const ToolSolid& cutting) const;
    /// Returns where the tool is closest to the zone of a limit. Pre: clearance_to() returned a value.
    [[nodiscard]] ClosestPoint closest_to(const LimitState& limit, const Observation& now,
                                          const ToolSolid& cutting) const;
    [[nodiscard]] const documents::MeasureReading* reading_of(const std::string& measure,
                                                              const StepState& state) const noexcept;
    /// Updates whether a goal on a measure is next, and can be measured now.
    void update_need_of_measures(const StepState& state, std::size_t next_goal, bool is_in_bone, bool is_out, int held);
    /// Judges an implant as the hand leaves it: goals that it no longer reaches are lost.
    void judge_left(StepState& state, double time);
    void lose_goal(StepState& state, std::size_t goal);
    /// Judges the limits of an implant that read it as it is now.
    void hold_state(StepState& state, double time);
    static void follow(const Observation& now, double depth, double hand, double dt, StepState& state);
    /// Compares a measured value with its limit.
    void hold(LimitState& limit, double value, double time);

    const documents::Anatomy* anatomy_;
    const std::vector<documents::Measure>* measures_;
    std::vector<AxisFrame> frames_;
    Owners owners_;  ///< at first body 0 owns all
    std::vector<StepState> steps_;
    std::size_t current_ = 0;
    bool is_released_ = false;
    bool is_measure_due_ = false, needs_measures_ = false;
    double depth_ = 0.0;   ///< [m] of the tip in the last tick
    double before_ = 0.0;  ///< [s] of the last observed tick
    std::vector<std::pair<std::string, std::string>> news_;
};

}  // namespace kerf::run
