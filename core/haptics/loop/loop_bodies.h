// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/haptics/law/bodies_view.h"
#include "core/haptics/law/body_threads.h"
#include "core/haptics/law/held_body.h"
#include "core/haptics/law/live_body.h"
#include "core/haptics/loop/loop_tools.h"
#include "core/haptics/loop/offer.h"

namespace kerf {

/// The tool in hand at one moment.
struct ToolNow {
    const LoopTools& tools;
    const Pose& world_from_tool;
    std::uint64_t tick;

    [[nodiscard]] const ToolOutline& outline() const noexcept { return tools.outline(); }
};

/// The bodies of a loop: their bone, the threads in it, the held body, and the records of the last tick.
class LoopBodies {
public:
    /// Everything is uncut. `first` must outlive it.   [main]
    LoopBodies(const Body& first, const ToolOutline& outline);

    [[nodiscard]] std::span<const std::unique_ptr<LiveBody>> all() const noexcept { return bodies_; }
    [[nodiscard]] const LiveBody& operator[](std::size_t body) const noexcept { return *bodies_[body]; }
    [[nodiscard]] std::size_t count() const noexcept { return bodies_.size(); }
    [[nodiscard]] const BodiesView& view() const noexcept { return view_; }
    [[nodiscard]] HeldBody& held() noexcept { return held_; }
    [[nodiscard]] const HeldBody& held() const noexcept { return held_; }
    [[nodiscard]] const BodyThreads& threads() const noexcept { return threads_; }
    /// Returns the records of the last tick, and those taken over since.
    [[nodiscard]] std::span<const CutRecord> closed() const noexcept { return closed_; }

    /// Returns whether bone is within `margin` [m] of the tool or of the held body.   [haptic, nonblocking]
    [[nodiscard]] bool is_in_reach(const ToolNow& tool, double margin) const noexcept;
    /// Returns whether some body has more cut than is committed in time.   [haptic, nonblocking]
    [[nodiscard]] bool is_behind() const noexcept;
    /// Returns the distance by which the tool must be moved back along its axis to be out of all bone [m].   [main]
    [[nodiscard]] double distance_out_of_bone(const ToolNow& tool) const;

    /// Drops the records of the last tick.   [haptic, nonblocking]
    void begin_tick() noexcept;
    /// Moves the held body and records the cut, if there is one, up to the tool's new pose. `is_at_front`: an edge met
    /// uncut bone in this step.   [haptic, nonblocking]
    void cut(const ToolNow& tool, bool is_cutting, bool is_at_front) noexcept;
    /// Updates the view of the bodies near the tool.   [haptic, nonblocking]
    void update_view(const ToolNow& tool) noexcept;
    /// Starts the stretches of all bodies at the tool's pose.   [haptic, nonblocking]
    void restart_stretches(const ToolNow& tool) noexcept;
    void clear_closed() noexcept { closed_.clear(); }
    /// Closes the open stretches and adds their records to `closed`.   [haptic, nonblocking]
    void close_stretches(std::uint64_t tick) noexcept;
    /// Changes to the tool in hand. Pre: everything is committed.   [main] between ticks
    void take_tool(const ToolNow& tool);

    /// Lets the tool hold a body. Returns false if there is only one: the patient.   [haptic, nonblocking]
    bool hold(std::size_t body, const Pose& world_from_tool) noexcept;
    /// Keeps a thread that the law left. Returns false if a new one finds no capacity.   [haptic, nonblocking]
    bool keep(const kerf_thread& thread) noexcept;

    /// Allocates for coming cuts.   [main] between ticks
    void reserve();
    /// Commits everything that is closed. It may allocate.   [main] between ticks
    void flush();

    [[nodiscard]] BodyStates body_states() const noexcept;
    [[nodiscard]] std::uint64_t next_sequence() const noexcept;
    /// Takes over a change of bodies. See `HapticLoop::take`.   [haptic, nonblocking] between ticks
    bool take(Offer& offer, const ToolNow& tool) noexcept;
    void place(std::size_t body, const Pose& world_from_body, const ToolNow& tool) noexcept;
    void show(std::size_t body, bool is_present, const ToolNow& tool) noexcept;
    void remove_held(const ToolNow& tool) noexcept;

private:
    [[nodiscard]] bool take_turn(Offer& offer, const ToolNow& tool) noexcept;
    [[nodiscard]] bool take_change(Offer& offer, const ToolNow& tool) noexcept;
    [[nodiscard]] bool stamp_missing(const Offer& offer, const LoopTools& tools) noexcept;
    void continue_bodies(const Offer& offer) noexcept;
    void start_body(LiveBody& body, const BodyState& body_state, const ToolNow& tool) const noexcept;
    void exchange_bodies(Offer& offer) noexcept;
    void add_subtracted(Offer& offer, std::uint64_t tick) noexcept;
    void take_closed(CutTracker& tracker, int count) noexcept;

    std::vector<std::unique_ptr<LiveBody>> bodies_;  ///< at the index of their id; capacity for `max_bodies`
    BodyThreads threads_;
    BodiesView view_;
    HeldBody held_;
    int bricks_left_ = 0;            ///< that this tick may still stamp
    std::vector<CutRecord> closed_;  ///< capacity for one tick, a turn and a subtraction
    std::uint64_t removing_ = 0;     ///< number of closed records that removed bone
};

}  // namespace kerf
