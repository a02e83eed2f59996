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

/// Steps in file order, their goals and limits, tick by tick. A pure function of what it is shown.
namespace kerf {

/// The frame of a step: its axis, from the first bone along it.
struct AxisFrame {
    Vec3 entry{};                   ///< LPS [m]
    Vec3 along{};                   ///< unit, into the bone
    Vec3 medial{};                  ///< unit, across the axis towards the landmark `midline`; zero without it
    Vec3 across{};                  ///< unit, across the axis along the normal of the step's plane; zero without one
    Vec3 inwards{};                 ///< unit, straight into the bone's surface at the entry; zero: along
    std::optional<double> plate{};  ///< [m] depth of the middle of the metal around an implant's hole; none: a landmark

    [[nodiscard]] double depth_of(Vec3 point) const noexcept { return dot(point - entry, along); }
    /// In the plane, beside the axis: the tool's x.
    [[nodiscard]] Vec3 aside() const noexcept { return cross(across, along); }
    /// Tool pose at a waypoint: tip there, +z along the axis and, with a plane, y along its normal.
    [[nodiscard]] Pose pose_at(const Waypoint& waypoint) const noexcept;
};
/// `plane` may be null.
[[nodiscard]] AxisFrame axis_frame(const LandmarkAxis& axis, double entry_along_axis, const Anatomy& anatomy,
                                   const LandmarkPlane* plane = nullptr) noexcept;

/// How far the outline of a solid stays from a zone [m]; negative inside. Looked at on rings along the outline.
[[nodiscard]] double clearance(const ToolSolid& solid, const Pose& world_from_tool, const Zone& zone) noexcept;

/// What one tick showed.
struct Observation {
    double time = 0.0;  ///< [s]
    Pose world_from_tool = identity_pose();
    bool is_running = false;                  ///< the tool removes what it sweeps
    bool is_resisted = false;                 ///< bone resists it
    double thrust = 0.0;                      ///< [N] of the bone on the tool, against its feed
    std::span<const Pose> world_from_body{};  ///< of each body; empty: there is one, and it has not moved
    int held = -1;                            ///< the body that the tool holds; −1: none
    bool is_bone_ahead = true;                ///< present bone in front of the tip
    double tip_inside = 0.0;                  ///< [m] of the tip below the surface of the bone before any cut
    Vec3 handle{};                            ///< [m] the place that the device reported, world frame
    double torque = 0.0;                      ///< [N·m] of the bone on the tool about its shaft, with its sign
    double lateral_force = 0.0;               ///< [N] of the bone on the tool, across its shaft
    double removed = 0.0;                     ///< [m³] in this step so far, as of the last count
    std::span<const double> signals{};        ///< of the tool's law, SI, in declared order
};

/// How the tip went on where there was no bone to stop it.
struct TipProgress {
    double front = 0.0;         ///< [m] the deepest that the tip has been, along the axis
    double in_air = 0.0;        ///< [s] that it went on at its front without bone ahead
    double depth_in_air = 0.0;  ///< [m] gained so
    double plunge = 0.0;        ///< [m] the farthest behind a face through which it left the bone
    double hand_plunge = 0.0;   ///< [m] that the hand moved on meanwhile, along the axis

    bool is_inside = false;                       ///< it has been within the bone since the last face
    std::optional<double> left_at, hand_left_at;  ///< [m] along the axis, where it left the bone last
};

/// The speed of the tip in bone. A tip that breaks through or chatters jumps within single ticks, so the speed is how
/// far the tip went in bone in the last 20 ticks.
class TipSpeed {
public:
    static constexpr std::size_t ticks = 20;

    /// Takes in a tick of `dt` [s]. `tip`: where it is now, as the bone sees it [m].
    void show(Vec3 tip, bool is_in_bone, double dt) noexcept;
    /// [m/s]
    [[nodiscard]] double value() const noexcept { return value_; }

private:
    std::array<Vec3, ticks> moved_{};  ///< [m] in each tick; zero in air
    std::size_t next_ = 0;
    std::optional<Vec3> before_;
    double value_ = 0.0;
};

/// A screw that a step has left in the bone.
struct InsertedScrew {
    double diameter = 0.0;           ///< [m] over its thread
    Breach breach{};                 ///< of its thread
    double least = 0.0, most = 0.0;  ///< [m] between which the breach lies
    std::string by_place{};          ///< its grade by where it breaches [heary-2004]; two where half a voxel decides
    std::optional<double> hole_offset{};  ///< [m] from the axis of the implant's hole, in the middle of the metal
    std::optional<double> hole_angle{};   ///< [rad] between both axes
};

/// What a step that drills, or inserts a screw, has left.
struct HoleResult {
    std::optional<DrilledHole> hole;                  ///< none: no section shows a whole circle
    std::optional<InsertedScrew> screw{};             ///< its axis is the hole's
    std::vector<std::pair<double, Breach>> breaches;  ///< diameter [m] of each cylinder that a limit names
};

/// How far a signal went that a goal or limit of the step names.
struct SignalState {
    const NamedSignal* signal = nullptr;
    double least = 0.0, greatest = 0.0;  ///< SI, in the ticks of the step
    bool is_seen = false;
};

struct LimitState {
    const Limit* limit = nullptr;
    double worst = 0.0;  ///< the value farthest towards the wrong side
    bool is_seen = false;
    std::optional<double> broken_at;  ///< [s]
};

struct StepState {
    const Step* step = nullptr;
    std::vector<bool> goal_done;
    std::vector<LimitState> limits;
    std::optional<double> start, end;  ///< [s]
    double deepest = -1.0;             ///< [m] of the tip in bone; negative until it has cut some
    double farthest_offset = 0.0;      ///< [m] of the tip from the axis while it cut bone
    bool has_met_bone_still = false;   ///< it stood on bone without running
    TipProgress advance;               ///< while it cut
    TipSpeed tip_speed;
    std::optional<CutWall> wall;         ///< that its cut left, measured when it had ended
    std::optional<HoleResult> drilled;   ///< the hole that it left, likewise
    std::optional<Reduction> reduction;  ///< of a fracture when the step had ended
    double removed = 0.0;                ///< [m³] in this step
    std::vector<SignalState> signals;    ///< each that the step names, once
    std::vector<bool> was_there;         ///< for each goal on a signal: the signal was within its bound in some tick
    std::vector<MeasureReading> measures{};  ///< of the procedure, as last measured in this step; empty: not yet

    bool is_released_at_end = false;  ///< its tool stays in the bone
    double moved = 0.0;               ///< [m] the farthest that the bone at the entry was from where it had been

    [[nodiscard]] bool has_cut_bone() const noexcept { return deepest >= 0.0; }
    [[nodiscard]] bool has_reached_all() const noexcept {
        return std::all_of(goal_done.begin(), goal_done.end(), [](bool done) { return done; });
    }
    [[nodiscard]] bool is_done() const noexcept { return end.has_value(); }
};

class StepMonitor {
public:
    /// Keeps references: procedure and anatomy must outlive it. `frames`: one per step.
    StepMonitor(const Procedure& procedure, const Anatomy& anatomy, std::vector<AxisFrame> frames);

    /// The tool of a step is an implant: the step ends when it is released, and not when it comes out again.
    void stays(std::size_t step) { steps_[step].is_released_at_end = true; }

    /// Shows one tick, of a tool whose cutting region is `cutting`.
    void observe(const Observation& now, const ToolSolid& cutting);
    /// Shows what the step that ended in the last tick left: the wall of its cut, if one was found, and what was
    /// `removed` in it [m³].
    void judge_cut(std::size_t step, const std::optional<CutWall>& wall, double removed, double time);
    /// Shows the hole that the step left.
    void judge_hole(std::size_t step, HoleResult drilled, double time);
    /// Whether a goal on a measure waits for the next measurement: the tool has come out of bone since the last one.
    [[nodiscard]] bool asks_for_measures() const noexcept { return asks_for_measures_; }
    /// Shows the procedure's measures to the step that runs, in their order.
    void show_measures(std::vector<MeasureReading> measures);
    /// Shows the measures that the step left, and compares them with its limits.
    void judge_measures(std::size_t step, std::vector<MeasureReading> measures, double time);
    /// An event that the tool's law reported in this tick.
    void report(const std::string& event, double time);
    /// The driver leaves an implant where it is: the step ends with the next tick. Returns why not; empty: it does.
    [[nodiscard]] std::string release();
    /// From now on a step is measured along this axis: that of an implant's hole, which was brought in.
    void aim(std::size_t step, const AxisFrame& frame) { frames_[step] = frame; }
    /// From now on things move with these bodies.
    void belong(Owners owners) { owners_ = std::move(owners); }
    [[nodiscard]] const Owners& owners() const noexcept { return owners_; }

    [[nodiscard]] const std::vector<StepState>& steps() const noexcept { return steps_; }
    [[nodiscard]] const std::vector<Measure>& measures() const noexcept { return *measures_; }
    /// Index of the step that runs; the number of steps when all are done.
    [[nodiscard]] std::size_t current() const noexcept { return current_; }
    [[nodiscard]] const AxisFrame& frame(std::size_t step) const noexcept { return frames_[step]; }
    /// What was newly reached or broken in the last tick, as text for the event list.
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& news() const noexcept { return news_; }

private:
    [[nodiscard]] bool is_reached(std::size_t goal, const StepState& state, const Observation& now) const noexcept;
    /// What a limit bounds, in this tick; nothing where the tick does not show it.
    [[nodiscard]] std::optional<double> measured(const LimitState& limit, const StepState& state,
                                                 const Observation& now, double depth, const ToolSolid& cutting) const;
    [[nodiscard]] std::optional<double> clearance_to(const LimitState& limit, const Observation& now,
                                                     const ToolSolid& cutting) const;
    [[nodiscard]] const MeasureReading* reading_of(const std::string& measure, const StepState& state) const noexcept;
    /// Notes whether a goal on a measure is next, and can be measured now.
    void ask_for_measures(const StepState& state, std::size_t next_goal, bool is_in_bone, bool is_out, int held);
    static void follow(const Observation& now, double depth, double hand, double dt, StepState& state);
    /// Compares a measured value with its limit.
    void hold(LimitState& limit, double value, double time);

    const Anatomy* anatomy_;
    const std::vector<Measure>* measures_;
    std::vector<AxisFrame> frames_;
    Owners owners_;  ///< at first all belongs to body 0
    std::vector<StepState> steps_;
    std::size_t current_ = 0;
    bool is_released_ = false;
    bool is_measure_due_ = false, asks_for_measures_ = false;
    double depth_ = 0.0;   ///< [m] of the tip in the last tick
    double before_ = 0.0;  ///< [s] of the last tick that was shown
    std::vector<std::pair<std::string, std::string>> news_;
};

}  // namespace kerf
