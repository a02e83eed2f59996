// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/loop/haptic_loop.h"
#include "core/haptics/loop/loop_change.h"
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

    /// Runs `HapticLoop::tick`, then lets the scene follow. If the tick stripped a thread, also subtracts the bone
    /// around it, so the caller need not.
    TickResult tick(const DeviceSample& sample);
    /// Runs `HapticLoop::tick_direct`, then does the same as `tick`.
    TickResult tick_direct(const DeviceSample& sample);
    /// Commits the last tool's cut and takes up another tool. Does nothing if `tool` is in hand already.
    void take_tool(std::size_t tool);
    /// Commits the last tool's cut and takes up a tool, also the one that is in hand already: such as the next implant
    /// of the same kind.
    /// @param back  [m] distance by which the tool is moved back along its axis first
    void take_another(std::size_t tool, double back = 0.0);
    /// Closes and commits all records, and takes over all separations. The committed cut and the present bone of each
    /// body then have the same bits.
    void finish();

    /// From now on, makes separated pieces larger than `crumb` [m³] into bodies. Pre: no tick has run.
    void find_pieces(double crumb, BodyOwnership belongings = {}) { scene_.find_pieces(crumb, std::move(belongings)); }
    /// Replays the adoptions of a recorded run: `ticks` lists the tick of each, in their order. Ticks then take over
    /// one separation for each entry, and none `adoption_delay` ticks after its record.
    void replay_adoptions(std::vector<std::uint64_t> ticks) { adoption_ticks_ = std::move(ticks); }
    /// Returns the separations taken over since the last call.
    [[nodiscard]] std::vector<Separation> take_separations() { return std::exchange(separations_, {}); }
    /// Returns the body that each zone and step belongs to now.
    [[nodiscard]] const Owners& owners() const noexcept { return scene_.owners(); }

    /// Adds a second cuttable body of the same tissues; `undo` does not remove it. `body` must outlive this object.
    /// Pre: no tick has run.
    void begin_with(const Body& body, const Pose& world_from_body);
    /// Adds another body, which must outlive this object. If it is not cuttable, it stops cutting tools. Returns an
    /// empty text, or the reason why it cannot be added: there are sixteen bodies, or it is cuttable and has other
    /// tissues.
    /// @param rigid_to  index of the body with which it moves; none: it moves alone
    std::string insert(const Body& body, const Pose& world_from_body, bool is_cuttable,
                       std::optional<std::size_t> rigid_to = {});
    /// Removes the bone inside a solid, at a pose of its tool, from every present, cuttable body.
    /// @param solid  index of a tool for its cutting solid, or `crest_number`
    void subtract(std::size_t solid, const Pose& world_from_tool);
    /// Fuses the held body with the cuttable body nearest to it: a bridge of bone fills the gap between them, and they
    /// are rigid to each other from now on. Returns the reason if they cannot be fused, else an empty text.
    std::string fuse();
    /// Restores the bone, its pieces and their poses to the state before the last change: a cut, an insertion, a fusion
    /// or a subtraction. A cut lasts from the first bone removed until the tool is clear of bone. Returns the reason if
    /// the tool touches bone or no change is left, else empty; then nothing changes.
    std::string undo() { return turn_back(HistoryChange::undo); }
    /// Repeats the change that was undone last. A new change leaves nothing to repeat. Returns as `undo`.
    std::string redo() { return turn_back(HistoryChange::redo); }

    // ---- a second loop, which ticks ahead

    /// Returns a loop in the state of this one, with `free_bricks` free bricks in each body. Given the same samples and
    /// changes, it gives the same bits. Takes the arguments of the constructor. Pre: no tick has run.   [main]
    [[nodiscard]] std::unique_ptr<HapticLoop> second_loop(std::vector<Tool> tools, const CouplingGains& gains,
                                                          const Pose& start, std::size_t free_bricks) const;
    /// From now on, changes of bodies are only prepared: `insert`, `subtract`, `fuse`, `undo` and `redo` return as
    /// before, and `make_change` makes the change that they prepared, after the same tick as the second loop. So are
    /// the bone around a stripped thread, and the contact points of a held body. Separations are made after the ticks
    /// that `adopt_after` names. Pre: those functions are called only while `is_ready_for_change`.
    void defer_changes();
    /// Returns whether no change is prepared and no separation waits.
    [[nodiscard]] bool is_ready_for_change() const noexcept {
        return !prepared_.is_any() && !stripped_at_ && scene_.waiting() == nullptr;
    }
    /// Returns the prepared change, or null.
    [[nodiscard]] const LoopChange* prepared() const noexcept { return prepared_.is_any() ? &prepared_ : nullptr; }
    /// Returns a copy of the prepared change for the second loop.
    [[nodiscard]] LoopChange prepared_for_second() const;
    /// Makes the prepared change. Pre: there is one.
    void make_change();
    /// Drops the prepared change.
    void drop_change();
    /// Prepares the prepared change anew if it depends on the bone.
    void renew_change();
    /// Returns the bodies with many records to commit, for a second loop that takes another tool.
    [[nodiscard]] Offer committed_for_second() const;
    /// Returns the first separation that waits, or null.
    [[nodiscard]] const Separation* waiting_separation() const noexcept { return scene_.waiting(); }
    /// Returns that separation as an offer for the second loop. Pre: one waits.
    [[nodiscard]] Offer separation_for_second() const { return scene_.separation(); }
    /// Makes the next separation at the end of the tick before `ticks` ticks have run.
    void adopt_after(std::uint64_t ticks) { adoption_ticks_->push_back(ticks); }

    /// Returns whether a cut is open: a record was applied since the tool was last clear of bone.
    [[nodiscard]] bool is_in_a_cut() const noexcept { return scene_.is_in_a_cut(); }

    /// Returns the present bone: all records are applied, without lag.
    [[nodiscard]] const PresentBone& present() const noexcept { return scene_.bone(); }
    [[nodiscard]] PresentBone& present() noexcept { return scene_.bone(); }
    [[nodiscard]] const CutField& exact(std::size_t body = 0) const noexcept { return present().cut(body); }

    /// Returns the loop, for callers that measure or watch its tick alone. They must call `follow` after each tick.
    [[nodiscard]] HapticLoop& loop() noexcept { return *this; }
    [[nodiscard]] const HapticLoop& loop() const noexcept { return *this; }
    /// Applies the records of a tick of `loop()` to the scene, allocates for coming cuts, and takes over the
    /// separations that are due: `adoption_delay` ticks after the record that separated the body, or as
    /// `replay_adoptions` set.
    void follow();

private:
    using HapticLoop::close_more_stretches;
    using HapticLoop::close_stretches;
    using HapticLoop::flush;
    using HapticLoop::make_room;
    using HapticLoop::set_held_points;
    using HapticLoop::take;

    void close_and_follow();
    void follow_from(std::size_t first);
    /// Does all that follows a tick of the loop: `follow`, stripped threads, changes to prepare.
    void follow_tick(const TickResult& result);
    void strip();
    void prepare_late_changes();
    void apply_held_back();
    void change(Offer offer);
    void take_over(Offer offer);
    void take_separations_due(bool all);
    std::string turn_back(HistoryChange turn);

    struct Subtraction {
        std::uint16_t solid = 0;
        Pose world_from_tool;
    };
    void prepare(const Subtraction& subtraction);

    BoneScene scene_;
    bool is_deferring_ = false;
    LoopChange prepared_;
    /// Records since an insertion or fusion was prepared. They wait for it: a piece that they separate would get its
    /// id.
    std::vector<CutRecord> held_back_;
    std::optional<Subtraction> subtracting_;  ///< what `prepared_` subtracts
    std::optional<Subtraction> stripped_at_;  ///< waits until it can be prepared
    std::vector<Separation> separations_;
    std::optional<std::vector<std::uint64_t>>
        adoption_ticks_;  ///< ticks of the adoptions still to come; no value: each after `adoption_delay`
};

}  // namespace kerf
