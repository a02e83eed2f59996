// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/haptics/law/guide_wall.h"
#include "core/haptics/loop/following.h"
#include "core/haptics/loop/hand_port.h"
#include "core/haptics/loop/law_ledger.h"
#include "core/haptics/loop/loop_bodies.h"
#include "core/haptics/loop/loop_change.h"
#include "core/haptics/loop/loop_tools.h"
#include "core/haptics/loop/offer.h"
#include "core/haptics/loop/tick_result.h"
#include "core/haptics/loop/unresisted_watch.h"

namespace kerf {

/// The haptic loop: one tool among bodies, from pose read to force out.
///
/// The loop has no history and does not find separated pieces: a `BoneScene` does. After each tick the scene reads the
/// records in `closed`, and it offers changes of bodies. `Simulation` runs both in lock-step; `SurfaceWorker` runs the
/// scene on another thread.
class HapticLoop {
public:
    static constexpr double dt = 1e-3;  ///< [s] default period of a tick
    /// Minimum number of ticks from the record that separated a body until the loop takes over its parts. A worker has
    /// this time to make them.
    static constexpr std::uint64_t adoption_delay = 20;

    /// Starts with uncut bone and the tool at `start`, which is also the hand's pose. A tool that starts in bone is
    /// moved back along its axis until it is free, with the event `haptics.started_in_bone`. Pre: `outline_of`
    /// succeeded for this setup.   [main]
    /// @param period  [s] of a tick
    HapticLoop(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains, const Pose& start,
               double period = dt);
    /// Starts with several tools, the first of them in hand. Pre: there is at least one.   [main]
    HapticLoop(const Body& body, std::vector<Tool> tools, const CouplingGains& gains, const Pose& start,
               double period = dt);
    ~HapticLoop();
    HapticLoop(const HapticLoop&) = delete;
    HapticLoop& operator=(const HapticLoop&) = delete;

    // ---- the tick

    /// Runs one tick: reads the hand, finds the motion at which hand and bone balance, applies it, gates the force and
    /// writes the command to the device.
    ///
    /// Where a point of the tool would move by more than half a voxel with bone in reach, the tick has up to 16 equal
    /// parts, each with its own law and its fraction of the hand's motion. The tool lags behind the hand if 16 parts
    /// are not enough, and beyond 1 m/s in bone. It also lags while too much cut bone waits to be committed (event
    /// `haptics.held_back`). An invalid pose, a jump of the hand, three missed ticks, an unsound law or a failed solve
    /// close the force gate: the tool rests and the force fades to zero. Afterwards the coupling starts without stretch
    /// from the poses of hand and tool.   [haptic, nonblocking]
    TickResult tick(const DeviceSample& sample) noexcept;
    /// Runs one tick of `coupling: direct`: the tool is rigid to the hand, and the law is evaluated at the hand's rate,
    /// without solve and force gate. It shows where direct rendering fails, and tests use it to prescribe an exact
    /// feed. [haptic, nonblocking]
    TickResult tick_direct(const DeviceSample& sample) noexcept;
    [[nodiscard]] std::uint64_t ticks() const noexcept { return tick_; }

    // ---- the tool

    /// Sets a drive from the next tick on, clamped to its range. Called for a pedal, a trigger or a procedure's step.
    /// [haptic, nonblocking] between ticks
    void command_drive(std::size_t drive, double value) noexcept {
        if (tools_.command_drive(drive, value)) ledger_.change_drive();
    }
    /// From the next tick on, lets the handle turn about the shaft without turning the tool, or grips the tool again
    /// (false). Used for a hand that regrips and for a device's clutch. `take_tool` always grips.
    /// [haptic, nonblocking] between ticks
    void loosen_about_shaft(bool is_loose) noexcept { hand_.loosen_about_shaft(is_loose); }
    /// Takes up a tool at the pose of the last one and starts its law anew. If it lies in bone there, moves it back
    /// along its axis, with the event `haptics.started_in_bone`. Releases the held body. Pre: `close_stretches` was
    /// called, and the scene has applied its records.   [main] between ticks; on the clock [haptic]
    /// @param back  [m] distance by which the tool is moved back along its axis first, such as a driver that leaves its
    ///              implant
    void take_tool(std::size_t tool, double back = 0.0);
    /// Sets the sleeve that guides the tool from the next tick on; no value: none.   [haptic, nonblocking] between
    /// ticks
    void lead(const std::optional<Guide>& guide) noexcept { guide_ = guide; }

    /// Returns whether the tool moves in the hand: it is in air, and was newly taken, or anchored anew after a fault.
    [[nodiscard]] bool is_realigning() const noexcept { return hand_.is_realigning() && tools_.law().count == 0; }
    /// Returns tool_from_handle without stretch: how the tool lies in the hand.   [haptic, nonblocking]
    [[nodiscard]] Pose grasp() const noexcept { return hand_.grasp(world_from_tool_); }
    [[nodiscard]] std::size_t tool() const noexcept { return tools_.in_hand(); }
    [[nodiscard]] const ToolOutline& outline() const noexcept { return tools_.outline(); }
    [[nodiscard]] const ToolSetup& setup() const noexcept { return tools_.setup(); }
    [[nodiscard]] const Pose& world_from_tool() const noexcept { return world_from_tool_; }
    [[nodiscard]] const double* signals() const noexcept { return tools_.signals(); }
    /// Returns the plugin's state, as bytes.
    [[nodiscard]] const std::byte* state() const noexcept { return tools_.state(); }
    [[nodiscard]] std::size_t state_size() const noexcept { return setup().force->force->state_size; }
    /// Returns the cutting solid of each tool, then the cylinder over the thread of each: the order of the solid
    /// numbers in cut records.   [main]
    [[nodiscard]] std::vector<const ToolSolid*> cutting_solids() const { return tools_.cutting_solids(); }
    [[nodiscard]] const ToolSolid& solid(std::size_t number) const noexcept { return tools_.solid(number); }
    /// Returns the number of the cylinder over the thread of the tool in hand.
    [[nodiscard]] std::size_t crest_number() const noexcept { return tools_.crest_number(); }
    /// Returns the maximum speed at which a tool follows the hand near bone [m/s]: half a voxel in each part of a tick.
    [[nodiscard]] double fastest_near_bone() const noexcept { return half_voxel() * max_parts / period_; }

    // ---- for viewers, between ticks; no tick calls these functions

    /// Returns the law of the last step. Its directions are in the frame of the tool before that step.
    [[nodiscard]] const EvaluatedLaw& law() const noexcept { return tools_.law(); }
    /// Returns the rate of the tool in the last step, tool frame; zero if the tool rested.
    [[nodiscard]] const Vec6& last_rate() const noexcept { return last_rate_; }
    /// Evaluates the law once more, at the present pose, with another query of the bone, and keeps nothing of it.
    /// Returns the plugin's status. Pre: `law` has a capacity of KERF_MAX_CHANNELS channels.   [main]
    [[nodiscard]] kerf_status evaluate_with(const kerf_bone_query& bone, kerf_law& law) const noexcept {
        return tools_.evaluate_with(bone, period_, tick_, law);
    }
    /// Returns the coupling between the hand's last pose and the tool.
    [[nodiscard]] CoupledPoses coupled() const noexcept { return hand_.coupled(world_from_tool_); }

    // ---- its bodies

    [[nodiscard]] std::span<const std::unique_ptr<LiveBody>> bodies() const noexcept { return bodies_.all(); }
    [[nodiscard]] const BodiesView& bone() const noexcept { return bodies_.view(); }
    [[nodiscard]] const CutField& committed(std::size_t body = 0) const noexcept { return bodies_[body].committed; }
    [[nodiscard]] const CutTracker& tracker(std::size_t body = 0) const noexcept { return bodies_[body].tracker; }
    /// Returns the threads that taps and screws have cut into the bone.
    [[nodiscard]] const BodyThreads& threads() const noexcept { return bodies_.threads(); }
    /// Returns the index of the held body, or −1 if none is held.
    [[nodiscard]] int held() const noexcept {
        return bodies_.held().is_any() ? static_cast<int>(bodies_.held().body()) : -1;
    }
    /// Returns whether the bounding box of the tool meets no brick that had bone before the first cut. The held body's
    /// box must also meet no other body's. So a tool in its own cut is not clear.   [haptic, nonblocking]
    [[nodiscard]] bool is_clear_of_bone() const noexcept { return !bodies_.is_in_reach(now(), 0.0); }
    [[nodiscard]] BodyStates body_states() const noexcept { return bodies_.body_states(); }

    /// Moves a body; the motion cuts nothing.   [haptic, nonblocking] between ticks
    void place_body(std::size_t body, const Pose& world_from_body) noexcept {
        bodies_.place(body, world_from_body, now());
        ledger_.restart();
    }
    /// Puts a body into the scene, or takes it out (false).   [haptic, nonblocking] between ticks
    void show_body(std::size_t body, bool is_present) noexcept { bodies_.show(body, is_present, now()); }
    /// Takes the held body and all that is fused to it out of the scene.   [haptic, nonblocking] between ticks
    void remove_held() noexcept { bodies_.remove_held(now()); }
    /// Takes over a change of bodies and moves the replaced bodies into the offer. Returns false and changes no body if
    /// the offer is outdated; a new offer is needed then. An undo or redo is outdated if the tool is not
    /// `is_clear_of_bone`, or has removed bone since. Any other change is outdated if one of its fields lacks more than
    /// eight records that remove bone. An undo or redo first closes the open stretches, also if it then returns false.
    /// `closed` gets those records, and a subtraction's.   [haptic, nonblocking] between ticks
    bool take(Offer& offer) noexcept { return bodies_.take(offer, now()); }
    /// Takes over a change. Pre: `can_take` its offers.   [haptic] between ticks; a tool's law may take long to begin
    void take(LoopChange& change);
    /// Returns whether the offer can be taken over now, after `close_stretches`.   [haptic, nonblocking] between ticks
    [[nodiscard]] Takeover can_take(const Offer& offer) const noexcept { return bodies_.can_take(offer, now()); }

    // ---- its records

    /// Returns the records of the last `tick` or `close_stretches`, then those of changes taken over since.
    [[nodiscard]] std::span<const CutRecord> closed() const noexcept { return bodies_.closed(); }
    /// Returns the smallest sequence number that is above those of all records, over all bodies.
    [[nodiscard]] std::uint64_t next_sequence() const noexcept { return bodies_.next_sequence(); }
    /// Allocates bricks for coming cuts, and finds the held body's contact points if it lacks them.
    /// [main] between ticks
    void make_room() {
        reserve_bricks(bricks_of_a_tick);
        if (lacks_held_points()) set_held_points(held_points());
    }
    /// Allocates until at least `count` bricks of each body are free for coming cuts.   [main] between ticks
    void reserve_bricks(std::size_t count) { bodies_.reserve(count); }
    /// Returns whether a body is held of which no contact points are known.
    [[nodiscard]] bool lacks_held_points() const noexcept { return bodies_.held().lacks_points(); }
    /// Returns contact points on the surface of the held bodies, as committed.   [main] between ticks
    [[nodiscard]] HeldPoints held_points() const { return bodies_.held().points_of(bodies_.all()); }
    /// Sets the contact points of the held body. Ignores those of another grip.   [haptic, nonblocking] between ticks
    void set_held_points(const HeldPoints& points) noexcept { bodies_.held().set_points(points); }
    /// Closes the open stretches; `closed` then returns their records alone.   [haptic, nonblocking] between ticks
    void close_stretches() noexcept {
        bodies_.clear_closed();
        bodies_.close_stretches(tick_);
    }
    /// Closes the open stretches; `closed` then returns the last tick's records and these.   [haptic, nonblocking]
    /// between ticks
    void close_more_stretches() noexcept { bodies_.close_stretches(tick_); }
    /// Commits all closed records. It may allocate.   [main] between ticks
    void flush() { bodies_.flush(); }

    // ---- its faults

    /// Returns the last fault of a law: the cause of the event `haptics.quarantined`.
    [[nodiscard]] const LawFault& law_fault() const noexcept { return tools_.fault(); }
    /// Returns the point and depth of the event `haptics.unresisted`. Read it in the tick of the event.
    [[nodiscard]] const Unresisted& unresisted() const noexcept { return unresisted_.last(); }
    /// Returns the energy of the laws so far: the cause of the event `haptics.law_made_energy`.
    [[nodiscard]] const LawLedger& ledger() const noexcept { return ledger_; }
    /// Ends the second of the ledger early. Returns whether the law made energy in it.   [main] after the last tick
    [[nodiscard]] bool finish_ledger() noexcept { return ledger_.finish(); }
    /// Returns one line of text for each law of which more than 1 % of the calls took longer than it declares.   [main]
    [[nodiscard]] std::vector<std::string> laws_over_budget() const { return tools_.laws_over_budget(); }
    [[nodiscard]] const PassivityGuard& passivity() const noexcept { return hand_.passivity(); }
    /// Returns the energy that the coupling could give back to the hand if the handle were at this pose [J], device
    /// side.
    [[nodiscard]] double stored_at(const Pose& world_from_handle) const noexcept {
        return hand_.stored_at(world_from_handle, world_from_tool_);
    }

private:
    static constexpr int max_parts = 16;

    /// One step of a tick: its balance and the motion that solves it.
    struct Step {
        double dt = 0.0;  ///< [s]
        Balance balance;
        Motion motion;
    };

    [[nodiscard]] ToolNow now() const noexcept { return {tools_, world_from_tool_, tick_}; }
    [[nodiscard]] double half_voxel() const noexcept { return 0.5 * spacing_; }

    void start_tool();
    [[nodiscard]] TickResult begin_tick() noexcept;
    [[nodiscard]] bool read_hand(const DeviceSample& sample) noexcept;
    [[nodiscard]] bool evaluate(double step) noexcept;
    [[nodiscard]] bool move(TickResult& result) noexcept;
    [[nodiscard]] bool find_motion(const Pose& world_from_handle, Step& step) noexcept;
    [[nodiscard]] double travel_in(const Step& step) noexcept;
    [[nodiscard]] int choose_parts(const Step& step, double travel, bool is_fast, TickResult& result) noexcept;
    [[nodiscard]] bool is_skidding(const Step& step) const noexcept;
    void limit_speed(Step& step) noexcept;
    void report(const Step& step, double weight, TickResult& result) noexcept;
    void rest(TickResult& result) noexcept;
    [[nodiscard]] bool apply(const AppliedMotion& applied, TickResult& result) noexcept;
    void apply_action(const kerf_action& action, TickResult& result) noexcept;
    void add_contact_events(TickResult& result) noexcept;
    void end_tick(TickResult& result) noexcept;

    /// Events that were already reported. Metal and holding back are reported again after they were over; leaving the
    /// region and full threads are reported once.
    struct Reported {
        bool has_left_region = false, has_met_metal = false, has_full_threads = false, is_held_back = false;
        bool is_drawn_back = false;  ///< the tool was moved out of bone; the next tick reports it
    };

    double period_;   ///< [s] of a tick
    double spacing_;  ///< [m] of the first body's voxels
    std::uint64_t tick_ = 0;
    Pose world_from_tool_;
    Vec6 last_rate_{};  ///< of the tool in the last step, tool frame. It gives the tool's momentum, and the next solve
                        ///< starts there. The solution is the same from any start; a near one takes fewer iterations
    LoopTools tools_;
    LoopBodies bodies_;
    HandPort hand_;
    Following following_;
    std::optional<Guide> guide_;
    UnresistedWatch unresisted_;
    LawLedger ledger_;
    Reported reported_;
};

}  // namespace kerf
