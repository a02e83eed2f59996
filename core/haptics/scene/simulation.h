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

/// A haptic loop and its bone in lock-step, on one thread: after each tick the scene follows, and each change of bodies
/// is taken over at once. The bits are those of a loop on the clock that took the same changes over after the same
/// ticks.   [main]
class Simulation : private HapticLoop {
public:
    using HapticLoop::adoption_delay;
    using HapticLoop::dt;

    /// As `HapticLoop`.
    Simulation(const Body& body, ToolSetup setup, ToolOutline outline, const CouplingGains& gains, const Pose& start,
               double period = dt);
    Simulation(const Body& body, std::vector<Tool> tools, const CouplingGains& gains, const Pose& start,
               double period = dt);

    /// `HapticLoop::tick`; then the scene follows.
    TickResult tick(const DeviceSample& sample);
    /// `HapticLoop::tick_direct`; then the scene follows.
    TickResult tick_direct(const DeviceSample& sample);
    /// `HapticLoop::take_tool`. What the last tool cut is closed and committed before.
    void take_tool(std::size_t tool);
    /// The same, and another one of its kind where it is in hand already: the implant on it stayed in bone.
    /// @param back  [m] by which it is drawn back first
    void take_another(std::size_t tool, double back = 0.0);
    /// Closes and commits everything: both fields of a body then hold the same bits.
    void finish();

    /// Makes bodies of bone that comes apart, if it is larger than `crumb` [m³]. Pre: no tick was done.
    void look_for_pieces(double crumb, Belongings belongings = {}) {
        scene_.look_for_pieces(crumb, std::move(belongings));
    }
    /// The ticks after which separations were taken over in a run that is replayed, one by one, and no others.
    void replay_adoptions(std::vector<std::uint64_t> ticks) { adoption_ticks_ = std::move(ticks); }
    /// Returns what came apart and was taken over since the last call.
    [[nodiscard]] std::vector<Separation> take_separations() { return std::exchange(separations_, {}); }
    /// The body that each zone and step belongs to now.
    [[nodiscard]] const Owners& owners() const noexcept { return scene_.owners(); }

    /// Puts another body of the same tissues into the scene, which must outlive it, and cannot be taken back by `undo`.
    /// Pre: no tick was done.
    void begin_with(const Body& body, const Pose& world_from_body);
    /// Puts another body into the scene, which must outlive it; if it is not `cuttable`, it stops what would cut it.
    /// Returns why it cannot be, or nothing: there are sixteen, or its tissues are others.
    /// @param rigid_to  body that it is rigid to; none: it moves by itself
    std::string insert(const Body& body, const Pose& world_from_body, bool is_cuttable,
                       std::optional<std::size_t> rigid_to = {});
    /// Removes all that a solid holds at a pose of its tool from every body there.
    /// @param solid  the number of a tool, for what it cuts, or `crest_number`
    void subtract(std::size_t solid, const Pose& world_from_tool);
    /// Lets the body that is held grow together with the piece nearest to it: a bridge of bone fills the gap between
    /// them, and they are rigid to each other from now on. Returns why they cannot, or nothing.
    std::string fuse();
    /// Brings the bone, its pieces and where they are back to what they were before the last cut; one cut is all that
    /// is removed from leaving the air to being clear of the bone again. Returns why it cannot be, or nothing; then
    /// nothing has changed.
    std::string undo() { return turn_back(Turn::undo); }
    /// Does again what was taken back, until something else is cut. Returns as `undo`.
    std::string redo() { return turn_back(Turn::redo); }

    /// Whether bone was removed since the tool last touched none.
    [[nodiscard]] bool is_in_a_cut() const noexcept { return scene_.is_in_a_cut(); }

    /// Without lag.
    [[nodiscard]] const PresentBone& present() const noexcept { return scene_.bone(); }
    [[nodiscard]] PresentBone& present() noexcept { return scene_.bone(); }
    [[nodiscard]] const CutField& exact(std::size_t body = 0) const noexcept { return present().cut(body); }

    /// The loop alone, for what measures or watches its tick: `follow` has to come after each of them.
    [[nodiscard]] HapticLoop& loop() noexcept { return *this; }
    [[nodiscard]] const HapticLoop& loop() const noexcept { return *this; }
    /// Lets the scene follow a tick of `loop()`, makes room for coming cuts, and takes over each separation,
    /// `adoption_delay` ticks after the record that parted the body.
    void follow();

    using HapticLoop::bodies;
    using HapticLoop::bone;
    using HapticLoop::closed;
    using HapticLoop::command_drive;
    using HapticLoop::committed;
    using HapticLoop::fastest_near_bone;
    using HapticLoop::held;
    using HapticLoop::is_clear_of_bone;
    using HapticLoop::law_fault;
    using HapticLoop::laws_over_budget;
    using HapticLoop::lead;
    using HapticLoop::loosen_about_shaft;
    using HapticLoop::next_sequence;
    using HapticLoop::outline;
    using HapticLoop::passivity;
    using HapticLoop::place_body;
    using HapticLoop::placings;
    using HapticLoop::remove_held;
    using HapticLoop::setup;
    using HapticLoop::show_body;
    using HapticLoop::signals;
    using HapticLoop::state;
    using HapticLoop::state_size;
    using HapticLoop::stored_at;
    using HapticLoop::threads;
    using HapticLoop::ticks;
    using HapticLoop::tool;
    using HapticLoop::tracker;
    using HapticLoop::unresisted;
    using HapticLoop::world_from_tool;

private:
    void close_and_follow();
    void follow_from(std::size_t first);
    void strip();
    void take_over(Offer offer);
    void take_separations_due(bool all);
    std::string turn_back(Turn turn);

    BoneScene scene_;
    std::vector<Separation> separations_;
    std::optional<std::vector<std::uint64_t>> adoption_ticks_;  ///< of those still to come; none: as soon as may be
};

}  // namespace kerf
