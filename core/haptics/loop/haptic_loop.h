// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/law/bodies_view.h"
#include "core/haptics/law/call_times.h"
#include "core/haptics/law/evaluate_law.h"
#include "core/haptics/law/guide_wall.h"
#include "core/haptics/law/held_body.h"
#include "core/haptics/law/law_fault.h"
#include "core/haptics/law/tool.h"
#include "core/haptics/loop/coupling.h"
#include "core/haptics/loop/following.h"
#include "core/haptics/loop/force_gate.h"
#include "core/haptics/loop/hand_motion.h"
#include "core/haptics/loop/offer.h"
#include "core/haptics/loop/passivity.h"

/// The haptic loop: one tool among bodies, from pose read to force out.
namespace kerf {

/// What one tick came to. Wrenches: world frame. Bone newtons unless said otherwise. In fast motion a tick has several
/// parts: rates, wrenches and powers are then their mean.
struct TickResult {
    static constexpr std::size_t most_events = 2 * KERF_MAX_ACTIONS;

    Pose world_from_tool = identity_pose();
    Vec6 rate{};                  ///< of the tool, tool frame
    Vec6 bone_on_tool{};          ///< modelled, about the tip
    Vec6 coupled_on_hand{};       ///< what an unlimited coupling would carry, at the grip
    Vec6 limited_on_hand{};       ///< what it carried
    Vec3 released_on_hand{};      ///< of that, what the release damper did [N]
    DeviceCommand command;        ///< to the device [device newtons]
    double thrust = 0.0;          ///< [N] bone on tool, against the shaft
    double torque = 0.0;          ///< [N·m] about the shaft
    double power_hand = 0.0;      ///< [W] from the hand into the tool
    int parts = 1;                ///< 1 … 16: how often the law was asked
    int iterations = 0;           ///< of the hardest of their solves
    bool is_cutting = false;      ///< the plugin removed bone in this tick
    bool is_stripping = false;    ///< it asked for the bone around the tool's thread: who drives the loop subtracts
                                  ///< the solid `crest_number` where the tool is, as `Simulation` does
    bool is_at_metal = false;     ///< the tool meets a body that cannot be cut
    bool is_quarantined = false;  ///< the law was unsound or the solve failed: the tool rests
    bool is_barred = false;       ///< after a fault: the force of before is fading, or gone
    bool is_coming_back = false;  ///< after that: less force is allowed than the device can make
    std::size_t event_count = 0;
    const char* events[most_events]{};

    void add_event(const char* id) noexcept {
        if (event_count < most_events) events[event_count++] = id;
    }
};

/// A part of the tool that cuts nothing is in uncut bone, and no channel of the law resists it there.
struct Unresisted {
    Vec3 point{};        ///< tool frame
    double depth = 0.0;  ///< [m] at least
};

/// It knows the bone as its last ticks have left it, and what edges read of it. What the bone has become besides,
/// pieces and undo, is kept by a `BoneScene`, which reads `closed` after each tick and offers changes: `Simulation`
/// does so in lock-step, `SurfaceWorker` on another thread.
class HapticLoop {
public:
    static constexpr double dt = 1e-3;  ///< [s] of a tick, unless another period is asked for

    /// Pre: `outline_of` succeeded for this setup. Everything is uncut. The tool begins at `start`, where the hand is;
    /// if that lies in bone, drawn back along its axis until it is free, with the event `haptics.started_in_bone`.
    /// [main]
    HapticLoop(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains, const Pose& start,
               double period = dt);
    /// The same with several tools, the first of them in hand. Pre: at least one.   [main]
    HapticLoop(const Body& body, std::vector<Tool> tools, const CouplingGains& gains, const Pose& start,
               double period = dt);
    ~HapticLoop();
    HapticLoop(const HapticLoop&) = delete;
    HapticLoop& operator=(const HapticLoop&) = delete;

    /// One millisecond.
    ///
    /// Where a point of the tool would move by more than half a voxel with bone in reach, the tick is done in up to 16
    /// equal parts, each with its own law and its part of the hand's way; beyond that, at more than 1 m/s, or while too
    /// much that was cut waits to be committed (the event `haptics.held_back`), the tool is slower than the hand (R1,
    /// B9). A sample that is no pose, a leap of the hand, three missed ticks or an unsound law bar the force gate: the
    /// tool rests, the force fades, and hand and tool go on from where they are.   [haptic, nonblocking]
    TickResult tick(const DeviceSample& sample) noexcept;

    /// `coupling: direct`: the tool is where the device says, the law is evaluated at the device's rate, and nothing
    /// is solved. Shows where the papers' way fails, and prescribes a feed exactly in tests.   [haptic, nonblocking]
    TickResult tick_direct(const DeviceSample& sample) noexcept;

    /// Sets a drive channel from the next tick on: a pedal, a trigger, a step of the procedure. Beyond its range it is
    /// held at the end of it.   [haptic, nonblocking] between ticks
    void command_drive(std::size_t drive, double value) noexcept;

    /// Lets the tool go about its shaft from the next tick on, or takes hold of it again (false): a hand that regrips,
    /// a clutch of a live device. The tool's angle stays, and the handle turns without it. A tool that is taken up is
    /// held. [haptic, nonblocking] between ticks
    void loosen_about_shaft(bool is_loose) noexcept { coupling_.loosen_about_shaft(is_loose); }

    /// Takes up one of the tools anew, where the hand is, with its law as at the beginning; drawn back along its axis
    /// if it lies in bone there. What was held is let go. Pre: `close_stretches` was called and its records are
    /// applied. [main] between ticks
    /// @param back  [m] by which it is drawn back before that: a driver that leaves its implant
    void take_tool(std::size_t tool, double back = 0.0);
    [[nodiscard]] std::size_t tool() const noexcept { return tool_; }
    /// From the next tick on a sleeve leads the tool; nothing: none.   [main] between ticks
    void lead(const std::optional<Guide>& guide) noexcept { guide_ = guide; }

    /// Makes room for coming cuts. It may allocate.   [main] between ticks
    void make_room();
    /// Closes the open stretches; `closed` returns their records.   [haptic, nonblocking] between ticks
    void close_stretches() noexcept;
    /// The same; `closed` returns those of the last tick before them.   [haptic, nonblocking] between ticks
    void close_more_stretches() noexcept { close_open_stretches(); }
    /// Commits everything that is closed. It may allocate.   [main] between ticks
    void flush();

    /// Ticks from the record that parted a body until the loop knows its parts, at least: a worker has that long to
    /// make them.
    static constexpr std::uint64_t adoption_delay = 20;
    /// Takes over a change of bodies. Returns false and changes no body where the offer lacks more than eight records
    /// that remove bone, or, if it takes a cut back or does it again, where the tool touches bone or has removed some
    /// since it was made: another offer is needed then. What was replaced comes back in the offer. Such a turn closes
    /// open stretches, a subtraction adds its records: `closed`.   [haptic, nonblocking] between ticks
    bool take(Offer& offer) noexcept;
    /// Whether the tool and what it holds touch no bone, cut or uncut.   [haptic, nonblocking]
    [[nodiscard]] bool is_clear_of_bone() const noexcept { return !is_bone_in_reach(0.0); }
    [[nodiscard]] Placings placings() const noexcept;
    /// From here on no body has numbered a record.
    [[nodiscard]] std::uint64_t next_sequence() const noexcept;
    /// Of each tool what cuts, then of each the cylinder over its thread, as records number them.   [main]
    [[nodiscard]] std::vector<const ToolSolid*> cutting_solids() const;
    [[nodiscard]] const ToolSolid& solid(std::size_t number) const noexcept {
        return number < tools_.size() ? tools_[number].outline.cutting : tools_[number - tools_.size()].outline.crest;
    }
    /// The number of the cylinder over the thread of the tool in hand.
    [[nodiscard]] std::size_t crest_number() const noexcept { return tools_.size() + tool_; }
    /// What taps and screws have left in the bone.
    [[nodiscard]] const BodyThreads& threads() const noexcept { return threads_; }

    [[nodiscard]] std::span<const std::unique_ptr<LiveBody>> bodies() const noexcept { return bodies_; }
    /// Moves a body, between ticks; nothing is cut on the way.   [haptic, nonblocking]
    void place_body(std::size_t body, const Pose& world_from_body) noexcept;
    /// Takes a body out of the scene, or puts it back.   [haptic, nonblocking] between ticks
    void show_body(std::size_t body, bool is_present) noexcept;
    /// Takes what the tool holds out of the scene, all that is fused together.   [haptic, nonblocking] between ticks
    void remove_held() noexcept;
    /// The body that the tool holds; −1 for none.
    [[nodiscard]] int held() const noexcept { return held_.is_any() ? static_cast<int>(held_.body()) : -1; }

    /// Records of the last `tick` or `close_stretches`, and of what was taken over since.
    [[nodiscard]] std::span<const CutRecord> closed() const noexcept { return closed_; }
    [[nodiscard]] const CutField& committed(std::size_t body = 0) const noexcept { return bodies_[body]->committed; }
    [[nodiscard]] const BodiesView& bone() const noexcept { return view_; }
    [[nodiscard]] const Pose& world_from_tool() const noexcept { return world_from_tool_; }
    [[nodiscard]] const ToolOutline& outline() const noexcept { return tools_[tool_].outline; }
    [[nodiscard]] const ToolSetup& setup() const noexcept { return tools_[tool_].setup; }
    [[nodiscard]] const double* signals() const noexcept { return signals_; }
    [[nodiscard]] const CutTracker& tracker(std::size_t body = 0) const noexcept { return bodies_[body]->tracker; }
    /// What made the last `haptics.quarantined`.
    [[nodiscard]] const LawFault& law_fault() const noexcept { return law_fault_; }
    /// Where the last `haptics.unresisted` was, tool frame.
    [[nodiscard]] const Unresisted& unresisted() const noexcept { return unresisted_; }
    /// Which laws were slower than they declare, one line each.   [main]
    [[nodiscard]] std::vector<std::string> laws_over_budget() const;
    [[nodiscard]] const PassivityGuard& passivity() const noexcept { return guard_; }
    /// What the coupling would give back to a handle there [J], device side.
    [[nodiscard]] double stored_at(const Pose& handle) const noexcept {
        return coupling_.stored(handle, world_from_tool_);
    }
    [[nodiscard]] std::uint64_t ticks() const noexcept { return tick_; }
    /// The plugin's state, as bytes.
    [[nodiscard]] const std::byte* state() const noexcept { return state_; }
    [[nodiscard]] std::size_t state_size() const noexcept { return setup().force->force->state_size; }

    /// How fast it lets a tool follow the hand near bone [m/s]: half a voxel in each part of a tick.
    [[nodiscard]] double fastest_near_bone() const noexcept { return 0.5 * spacing_ * most_parts / period_; }

private:
    static constexpr int most_parts = 16;

    [[nodiscard]] kerf_tick_in tick_in(double step) const noexcept;  ///< of this tick
    [[nodiscard]] bool ask(double step) noexcept;
    bool release_because(LawFault fault) noexcept;  ///< false
    [[nodiscard]] bool is_skidding(const Balance& balance, const Motion& motion) const noexcept;
    [[nodiscard]] bool is_resisted_at(Vec3 point, const Motion& motion) const noexcept;
    void look_for_unresisted(const Motion& motion, TickResult& result) noexcept;
    /// [m] A millimetre and two voxels, as far as depths are known.
    [[nodiscard]] double unresisted_depth() const noexcept {
        return std::min(std::max(1e-3, 2.0 * spacing_), 0.9 * clamp_voxels * spacing_);
    }
    /// Holds, asks and solves for one step. False: the law or the solve is unsound.
    [[nodiscard]] bool find_motion(const Pose& handle, double step, Balance& balance, Motion& motion) noexcept;
    [[nodiscard]] bool move(const Pose& last_handle, TickResult& result) noexcept;
    void rest(TickResult& result) noexcept;
    void report(const Balance& balance, const Motion& motion, double share, TickResult& result) noexcept;
    void report_bone(const Vec6& bone_on_tool_in_tool, double share, TickResult& result) const noexcept;
    void commit(const Vec6& rate, const double* lambda, const Vec6& following, double step,
                TickResult& result) noexcept;
    void command(TickResult& result) noexcept;
    [[nodiscard]] Vec3 commanded_torque(Vec3 on_hand) noexcept;

    /// Whether any bone that can be felt comes within `margin` [m] of the tool.
    [[nodiscard]] bool is_bone_in_reach(double margin) const noexcept;
    void take_closed(CutTracker& tracker, int count) noexcept;
    void close_open_stretches() noexcept;
    void begin_with_tool();  ///< its law as at the beginning, out of bone
    void do_as_told(const kerf_action& action, TickResult& result) noexcept;
    void keep(const kerf_thread& thread, TickResult& result) noexcept;
    [[nodiscard]] static PassivityGuard::Port port_of_forces(const CouplingGains& gains) noexcept;
    [[nodiscard]] static PassivityGuard::Port port_of_shaft(const Coupling& coupling) noexcept;
    [[nodiscard]] bool take_turn(Offer& offer) noexcept;
    [[nodiscard]] bool take_change(Offer& offer) noexcept;
    [[nodiscard]] bool stamp_lacking(const Offer& offer) noexcept;
    void go_on(const Offer& offer) noexcept;
    void place_anew(LiveBody& body, const Placing& placing) noexcept;
    void exchange_bodies(Offer& offer) noexcept;
    void add_subtracted(Offer& offer) noexcept;
    void look_around() noexcept;

    double period_;  ///< [s] of a tick
    double spacing_;
    std::vector<Tool> tools_;  ///< records call them by their place here
    std::size_t tool_ = 0;
    std::array<double, KERF_MAX_DRIVES> drives_{};   ///< as commanded
    std::vector<std::unique_ptr<LiveBody>> bodies_;  ///< at the place of their id; room for all there may be
    BodyThreads threads_;
    BodiesView view_;
    HeldBody held_;

    std::unique_ptr<std::byte[]> state_storage_;
    std::byte* state_ = nullptr;
    double signals_[KERF_MAX_SIGNALS]{};
    EvaluatedLaw law_;    ///< of this tick, or of its last part
    Vec6 last_rate_{};    ///< of the tool in the last step, tool frame. The next solve starts there: its answer is the
                          ///< same from anywhere, and here it is near
    kerf_solid solid_{};  ///< of the held tool
    bool has_left_region_ = false, has_met_metal_ = false, has_no_room_ = false;
    std::optional<Guide> guide_;  ///< that leads the tool
    Following following_;

    Pose world_from_tool_;
    HandMotion hand_;
    Coupling coupling_;
    PassivityGuard guard_;
    ForceGate gate_;
    Vec6 commanded_{};       ///< the last command: on the hand, device newtons
    Vec6 before_fault_{};    ///< what the gate fades
    double supplied_ = 0.0;  ///< [J] what follows the law gave the last tick, device side
    LawFault law_fault_;
    Unresisted unresisted_;
    bool is_unresisted_ = false;  ///< reported, and not yet over
    bool is_new_tool_ = false;    ///< taken as the hand stood, and not yet straight in it
    ClockScale clock_scale_;
    std::vector<CallTimes> resist_times_;  ///< of each tool
    bool is_drawn_back_ = false, is_held_back_ = false;
    std::uint64_t tick_ = 0;
    int bricks_left_ = 0;            ///< that this tick may stamp yet
    std::vector<CutRecord> closed_;  ///< of the last tick; has room
    std::uint64_t removing_ = 0;     ///< records closed so far that remove bone
};

}  // namespace kerf
