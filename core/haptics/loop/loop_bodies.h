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
#include "core/haptics/loop/loop_change.h"
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
    /// Starts with one body, the uncut bone `first`, which must outlive this object.   [main]
    LoopBodies(const Body& first, const ToolOutline& outline);

    [[nodiscard]] std::span<const std::unique_ptr<LiveBody>> all() const noexcept { return bodies_; }
    [[nodiscard]] const LiveBody& operator[](std::size_t body) const noexcept { return *bodies_[body]; }
    [[nodiscard]] std::size_t count() const noexcept { return bodies_.size(); }
    [[nodiscard]] const BodiesView& view() const noexcept { return view_; }
    [[nodiscard]] HeldBody& held() noexcept { return held_; }
    [[nodiscard]] const HeldBody& held() const noexcept { return held_; }
    [[nodiscard]] const BodyThreads& threads() const noexcept { return threads_; }
    /// Returns the records of the last tick, then those of changes taken over since.
    [[nodiscard]] std::span<const CutRecord> closed() const noexcept { return closed_; }

    /// Returns whether the box of the tool, widened by `margin` [m], meets a brick that had bone before the first cut.
    /// Also true if the held body's box comes within `margin` of another body's.   [haptic, nonblocking]
    [[nodiscard]] bool is_in_reach(const ToolNow& tool, double margin) const noexcept;
    /// Returns whether a body has more pending records than `CutTracker::pending_limit`.   [haptic, nonblocking]
    [[nodiscard]] bool is_behind() const noexcept;
    /// Returns the distance by which the tool must be moved back along its axis to be out of the uncut bone of all
    /// bodies [m]. A body that it cannot leave within 0.3 m counts as 0.   [main]
    [[nodiscard]] double distance_out_of_bone(const ToolNow& tool) const;

    /// Drops the records of the last tick and resets the number of bricks that a tick may stamp.
    /// [haptic, nonblocking]
    void begin_tick() noexcept;
    /// Moves the held body with the tool. While cutting, extends the records to the tool's new pose; else closes them.
    /// Then commits the records that the tool has passed, and updates the view.   [haptic, nonblocking]
    /// @param is_at_front  whether an edge met uncut bone in this step
    void cut(const ToolNow& tool, bool is_cutting, bool is_at_front) noexcept;
    /// Sets the tool's pose in the view and selects the bodies near the tool.   [haptic, nonblocking]
    void update_view(const ToolNow& tool) noexcept;
    /// Starts new stretches at the tool's pose in all bodies. The motion since the last record is no cut.
    /// [haptic, nonblocking]
    void restart_stretches(const ToolNow& tool) noexcept;
    void clear_closed() noexcept { closed_.clear(); }
    /// Closes the open stretches and adds their records to `closed`.   [haptic, nonblocking]
    void close_stretches(std::uint64_t tick) noexcept;
    /// Makes all bodies cut by the tool in hand, and releases the held body. Pre: all records are committed.
    /// [main] between ticks
    void take_tool(const ToolNow& tool);

    /// Lets the tool hold a body. Returns false if there is only one body: the patient. Ignores a body that does not
    /// exist or is not present.   [haptic, nonblocking]
    bool hold(std::size_t body, const Pose& world_from_tool) noexcept;
    /// Stores a thread that the law has cut. Returns false if it is a new one and the table is full. Ignores one that
    /// is unsound or in no near body.   [haptic, nonblocking]
    bool keep(const kerf_thread& thread) noexcept;

    /// Allocates until at least `count` bricks of each body are free for coming cuts.   [main] between ticks
    void reserve(std::size_t count);
    /// Commits all closed records. It may allocate.   [main] between ticks
    void flush();

    [[nodiscard]] BodyStates body_states() const noexcept;
    [[nodiscard]] std::uint64_t next_sequence() const noexcept;
    /// Takes over a change of bodies. See `HapticLoop::take`.   [haptic, nonblocking] between ticks
    bool take(Offer& offer, const ToolNow& tool) noexcept;
    /// Returns whether `take` would succeed after the open stretches are closed.   [haptic, nonblocking] between ticks
    [[nodiscard]] Takeover can_take(const Offer& offer, const ToolNow& tool) const noexcept;
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
    int bricks_left_ = 0;            ///< number of bricks that this tick may still stamp
    std::vector<CutRecord> closed_;  ///< capacity for one tick, an undo or redo, and a subtraction
    std::uint64_t removing_ = 0;     ///< number of closed records that removed bone
};

}  // namespace kerf
