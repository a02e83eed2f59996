// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/loop/haptic_loop.h"
#include "core/haptics/scene/bone_scene.h"

namespace kerf {

/// A haptic loop with its scene in lock-step, on one thread: the scene follows each tick, and each change of bodies is
/// taken over at once. The result has the same bits as that of a loop on the clock which took over the same changes
/// after the same ticks. Functions of this class replace those of the loop with the same name; the loop's functions
/// that would break the lock-step are private here.   [main]
class Simulation : public HapticLoop {
public:
    Simulation(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains, const Pose& start,
               double period = dt);
    Simulation(const Body& body, std::vector<Tool> tools, const CouplingGains& gains, const Pose& start,
               double period = dt);

    /// Runs `HapticLoop::tick`, then lets the scene follow.
    TickResult tick(const DeviceSample& sample);
    /// Runs `HapticLoop::tick_direct`, then lets the scene follow.
    TickResult tick_direct(const DeviceSample& sample);
    /// Commits the last tool's cut and takes up another tool. Does nothing if it is in hand already.
    void take_tool(std::size_t tool);
    /// Commits the last tool's cut and takes up a tool, also one that is in hand already: its implant stayed in bone.
    /// @param back  [m] by which the tool is moved back first
    void take_another(std::size_t tool, double back = 0.0);
    /// Closes and commits everything. Both fields of a body then have the same bits.
    void finish();

    /// Makes bodies of bone that comes apart, if it is larger than `crumb` [m³]. Pre: no tick has run.
    void find_pieces(double crumb, BodyOwnership belongings = {}) { scene_.find_pieces(crumb, std::move(belongings)); }
    /// Takes over separations after these ticks alone, one after each: those of a run that is replayed.
    void replay_adoptions(std::vector<std::uint64_t> ticks) { adoption_ticks_ = std::move(ticks); }
    /// Returns the separations taken over since the last call.
    [[nodiscard]] std::vector<Separation> take_separations() { return std::exchange(separations_, {}); }
    /// Returns the body that each zone and step belongs to now.
    [[nodiscard]] const Owners& owners() const noexcept { return scene_.owners(); }

    /// Adds a second body of the same tissues; `undo` does not remove it. The body must outlive the scene. Pre: no tick
    /// has run.
    void begin_with(const Body& body, const Pose& world_from_body);
    /// Adds another body, which must outlive the scene. If it is not cuttable, it stops the tool. Returns the reason if
    /// it cannot be added, else empty: there are sixteen bodies, or its tissues differ.
    /// @param rigid_to  body that it is rigid to; none: it moves by itself
    std::string insert(const Body& body, const Pose& world_from_body, bool is_cuttable,
                       std::optional<std::size_t> rigid_to = {});
    /// Removes the bone inside a solid at a pose of its tool from every body there.
    /// @param solid  the number of a tool for its cutting solid, or `crest_number`
    void subtract(std::size_t solid, const Pose& world_from_tool);
    /// Fuses the held body with the piece nearest to it: a bridge of bone fills the gap between them, and they are
    /// rigid to each other from now on. Returns the reason if they cannot be fused, else empty.
    std::string fuse();
    /// Restores the bone, its pieces and their poses to the state before the last change: a cut, an insertion, a fusion
    /// or a subtraction. A cut lasts from the first bone removed until the tool is clear of bone. Returns the reason if
    /// the tool touches bone or no change is left, else empty; then nothing changes.
    std::string undo() { return turn_back(HistoryChange::undo); }
    /// Repeats the change that was undone, until another one is made. Returns as `undo`.
    std::string redo() { return turn_back(HistoryChange::redo); }

    /// Returns whether bone was removed since the tool last touched none.
    [[nodiscard]] bool is_in_a_cut() const noexcept { return scene_.is_in_a_cut(); }

    /// Returns the bone without lag.
    [[nodiscard]] const PresentBone& present() const noexcept { return scene_.bone(); }
    [[nodiscard]] PresentBone& present() noexcept { return scene_.bone(); }
    [[nodiscard]] const CutField& exact(std::size_t body = 0) const noexcept { return present().cut(body); }

    /// Returns the loop alone, for callers that measure or watch its tick: they must call `follow` after each tick.
    [[nodiscard]] HapticLoop& loop() noexcept { return *this; }
    [[nodiscard]] const HapticLoop& loop() const noexcept { return *this; }
    /// Lets the scene follow a tick of `loop()`, allocates for coming cuts, and takes over each separation
    /// `adoption_delay` ticks after the record that parted the body.
    void follow();

private:
    using HapticLoop::close_more_stretches;
    using HapticLoop::close_stretches;
    using HapticLoop::flush;
    using HapticLoop::make_room;
    using HapticLoop::take;

    void close_and_follow();
    void follow_from(std::size_t first);
    void strip();
    void take_over(Offer offer);
    void take_separations_due(bool all);
    std::string turn_back(HistoryChange turn);

    BoneScene scene_;
    std::vector<Separation> separations_;
    std::optional<std::vector<std::uint64_t>>
        adoption_ticks_;  ///< of those still to come; none: after `adoption_delay`
};

}  // namespace kerf
