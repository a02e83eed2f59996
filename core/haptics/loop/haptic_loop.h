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
#include "core/haptics/loop/loop_bodies.h"
#include "core/haptics/loop/loop_tools.h"
#include "core/haptics/loop/offer.h"
#include "core/haptics/loop/tick_result.h"
#include "core/haptics/loop/unresisted_watch.h"

namespace kerf {

/// The haptic loop: one tool among bodies, from pose read to force out.
///
/// It knows bone as of its last tick. A `BoneScene` keeps the rest, pieces and undo: it reads `closed` after each tick
/// and offers changes. `Simulation` runs both in lock-step; `SurfaceWorker` runs the scene on another thread.
class HapticLoop {
public:
    static constexpr double dt = 1e-3;  ///< [s] default period of a tick
    /// Minimum number of ticks from the record that parted a body until the loop takes over its parts: the time that a
    /// worker has to make them.
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
    /// parts, each with its own law and its fraction of the hand's motion. Beyond 16 parts, beyond 1 m/s in bone, or
    /// while cut bone waits to be committed (event `haptics.held_back`), the tool lags behind the hand. An invalid
    /// pose, a jump of the hand, three missed ticks or an unsound law close the force gate: the tool rests, the force
    /// fades, and hand and tool continue from their poses.   [haptic, nonblocking]
    TickResult tick(const DeviceSample& sample) noexcept;
    /// Runs one tick of `coupling: direct`: the tool is rigid to the hand, and the law is evaluated at the hand's rate
    /// without a solve. Shows where direct rendering fails, and prescribes a feed exactly in tests.
    /// [haptic, nonblocking]
    TickResult tick_direct(const DeviceSample& sample) noexcept;
    [[nodiscard]] std::uint64_t ticks() const noexcept { return tick_; }

    // ---- the tool

    /// Sets a drive from the next tick on, clamped to its range: a pedal, a trigger, a step of the procedure.
    /// [haptic, nonblocking] between ticks
    void command_drive(std::size_t drive, double value) noexcept { tools_.command_drive(drive, value); }
    /// Lets the tool turn about its shaft from the next tick on, or grips it again (false): a hand that regrips, a
    /// clutch of a device. The tool's angle stays, and the hand turns without it. A tool that is taken up is held.
    /// [haptic, nonblocking] between ticks
    void loosen_about_shaft(bool is_loose) noexcept { hand_.loosen_about_shaft(is_loose); }
    /// Takes up a tool at the hand's pose, with its law as at the start, and moves it back along its axis if it lies in
    /// bone there. Lets go of the held body. Pre: `close_stretches` was called and its records are applied.   [main]
    /// between ticks
    /// @param back  [m] by which it is moved back first: a driver that leaves its implant
    void take_tool(std::size_t tool, double back = 0.0);
    /// Leads the tool by a sleeve from the next tick on, or by none.   [main] between ticks
    void lead(const std::optional<Guide>& guide) noexcept { guide_ = guide; }

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

    // ---- its bodies

    [[nodiscard]] std::span<const std::unique_ptr<LiveBody>> bodies() const noexcept { return bodies_.all(); }
    [[nodiscard]] const BodiesView& bone() const noexcept { return bodies_.view(); }
    [[nodiscard]] const CutField& committed(std::size_t body = 0) const noexcept { return bodies_[body].committed; }
    [[nodiscard]] const CutTracker& tracker(std::size_t body = 0) const noexcept { return bodies_[body].tracker; }
    /// Returns the threads that taps and screws have left in the bone.
    [[nodiscard]] const BodyThreads& threads() const noexcept { return bodies_.threads(); }
    /// Returns the held body; −1 for none.
    [[nodiscard]] int held() const noexcept {
        return bodies_.held().is_any() ? static_cast<int>(bodies_.held().body()) : -1;
    }
    /// Returns whether tool and held body touch no bone, cut or uncut.   [haptic, nonblocking]
    [[nodiscard]] bool is_clear_of_bone() const noexcept { return !bodies_.is_in_reach(now(), 0.0); }
    [[nodiscard]] BodyStates body_states() const noexcept { return bodies_.body_states(); }

    /// Moves a body; the motion cuts nothing.   [haptic, nonblocking] between ticks
    void place_body(std::size_t body, const Pose& world_from_body) noexcept {
        bodies_.place(body, world_from_body, now());
    }
    /// Takes a body out of the scene, or puts it back.   [haptic, nonblocking] between ticks
    void show_body(std::size_t body, bool is_present) noexcept { bodies_.show(body, is_present, now()); }
    /// Takes the held body and all that is fused to it out of the scene.   [haptic, nonblocking] between ticks
    void remove_held() noexcept { bodies_.remove_held(now()); }
    /// Takes over a change of bodies; the replaced ones come back in the offer. Returns false and changes no body if
    /// the offer lacks more than eight records that remove bone. Returns false for an undo or redo if the tool touches
    /// bone or has removed some since the offer was made. Another offer is needed then. An undo or redo closes open
    /// stretches, a subtraction adds its records: see `closed`.   [haptic, nonblocking] between ticks
    bool take(Offer& offer) noexcept { return bodies_.take(offer, now()); }

    // ---- its records

    /// Returns the records of the last `tick` or `close_stretches`, and of changes taken over since.
    [[nodiscard]] std::span<const CutRecord> closed() const noexcept { return bodies_.closed(); }
    /// Returns the number that no body has given to a record yet, nor any above it.
    [[nodiscard]] std::uint64_t next_sequence() const noexcept { return bodies_.next_sequence(); }
    /// Allocates for coming cuts.   [main] between ticks
    void make_room() { bodies_.reserve(); }
    /// Closes the open stretches; `closed` then returns their records.   [haptic, nonblocking] between ticks
    void close_stretches() noexcept {
        bodies_.clear_closed();
        bodies_.close_stretches(tick_);
    }
    /// Closes the open stretches; `closed` then returns the last tick's records and these.   [haptic, nonblocking]
    /// between ticks
    void close_more_stretches() noexcept { bodies_.close_stretches(tick_); }
    /// Commits everything that is closed. It may allocate.   [main] between ticks
    void flush() { bodies_.flush(); }

    // ---- its faults

    /// Returns the fault of the last `haptics.quarantined`.
    [[nodiscard]] const LawFault& law_fault() const noexcept { return tools_.fault(); }
    /// Returns the point of the last `haptics.unresisted`, tool frame.
    [[nodiscard]] const Unresisted& unresisted() const noexcept { return unresisted_.last(); }
    /// Returns one line for each law that was slower than it declares.   [main]
    [[nodiscard]] std::vector<std::string> laws_over_budget() const { return tools_.laws_over_budget(); }
    [[nodiscard]] const PassivityGuard& passivity() const noexcept { return hand_.passivity(); }
    /// Returns the energy that the coupling would return to a hand at a pose [J], device side.
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
    void apply(const AppliedMotion& applied, TickResult& result) noexcept;
    void apply_action(const kerf_action& action, TickResult& result) noexcept;
    void add_contact_events(TickResult& result) noexcept;
    void end_tick(TickResult& result) noexcept;

    /// Events that are reported once until their cause is over.
    struct Reported {
        bool has_left_region = false, has_met_metal = false, has_full_threads = false, is_held_back = false;
        bool is_drawn_back = false;  ///< to report in the next tick
    };

    double period_;   ///< [s] of a tick
    double spacing_;  ///< [m] of the first body's voxels
    std::uint64_t tick_ = 0;
    Pose world_from_tool_;
    Vec6 last_rate_{};  ///< of the tool in the last step, tool frame. The next solve starts there. The solution is the
                        ///< same from any start; a near one takes fewer iterations
    LoopTools tools_;
    LoopBodies bodies_;
    HandPort hand_;
    Following following_;
    std::optional<Guide> guide_;
    UnresistedWatch unresisted_;
    Reported reported_;
};

}  // namespace kerf
