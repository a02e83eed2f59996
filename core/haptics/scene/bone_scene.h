// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/haptics/loop/offer.h"

/// The present bone and all changes of its bodies.
namespace kerf {

/// Owners of zones and steps, and the rule by which separated bodies inherit them.
struct BodyOwnership {
    /// A function that gives the zones and steps of body `from` to one of the `bodies` into which it was separated.
    using PassOn =
        std::function<void(Owners&, std::size_t from, const std::vector<std::size_t>& bodies, const PresentBone& bone)>;
    Owners owners;     ///< given to a scene: before its first change
    PassOn inherit{};  ///< empty: owners never change
};

/// Applies cut records to the present bone and makes all changes of bodies. A change has two steps. First the scene
/// makes an `Offer` and stays unchanged. After the haptic loop has taken the offer over, `taken` makes the same change
/// here. One thread uses the scene at a time: the loop's own in lock-step, else a worker's.
class BoneScene {
public:
    /// Maximum number of undo steps; the oldest is dropped.
    static constexpr std::size_t max_undo = 16;

    /// Starts with the uncut bone of `body` as body 0. `cutting` has the solids at the numbers that records name. Pre:
    /// `body` and the solids outlive this object.   [main]
    BoneScene(const Body& body, std::vector<const ToolSolid*> cutting);
    /// From now on, makes separated pieces larger than `crumb` [m³] into bodies, and removes smaller ones. Pre: no
    /// record has been applied.   [main]
    void find_pieces(double crumb, BodyOwnership belongings = {});

    [[nodiscard]] const PresentBone& bone() const noexcept { return bone_; }
    [[nodiscard]] PresentBone& bone() noexcept { return bone_; }
    [[nodiscard]] const Owners& owners() const noexcept { return belongings_.owners; }

    /// Applies records in their order; all of them remove bone. Begins a cut if none is open: `now`, the present states
    /// of the bodies, are what its undo restores.   [worker]
    void apply(std::span<const CutRecord> records, const BodyStates& now);
    /// Ends the open cut, if there is one; to be called when the tool is clear of bone. If the cut removed bone, it
    /// becomes an undo step, and the redo steps are dropped.   [worker]
    void end_cut();
    /// Sets the threads that undoing the next cut restores; to be called while the tool is clear of bone.   [worker]
    void set_threads(const BodyThreads& threads) noexcept { threads_ = threads; }
    /// Drops all undo and redo steps.   [worker]
    void forget_changes() noexcept {
        undo_.clear();
        redo_.clear();
    }
    [[nodiscard]] bool is_in_a_cut() const noexcept { return before_cut_.has_value(); }
    [[nodiscard]] bool can(HistoryChange turn) const noexcept { return !snapshots(turn).empty(); }

    /// Returns the first separation that the loop has not taken over, or null.
    [[nodiscard]] const Separation* waiting() const noexcept {
        return waiting_.empty() ? nullptr : &waiting_.front().separation;
    }

    /// Returns an offer of the first waiting separation. Pre: `waiting()` is not null.   [worker]
    [[nodiscard]] Offer separation() const;
    /// Returns an offer of all bodies as they were before the last change (undo), or after the change undone last
    /// (redo). Pre: `can(turn)`, and not in a cut.   [worker]
    [[nodiscard]] Offer turn(HistoryChange turn) const;
    /// Returns an offer of another body. `body` must outlive this object and the loop. A body that is not cuttable
    /// stops cutting tools. The offer is empty and `why_not` has the reason if there are sixteen bodies, or if a
    /// cuttable body has other tissues than body 0. Pre: no separation waits.   [worker]
    [[nodiscard]] Offer insertion(const Body& body, const Pose& world_from_body, bool is_cuttable,
                                  const BodyStates& now, std::string& why_not) const;
    /// Returns an offer of a bone bridge, a new body, between body `held` and the cuttable body nearest to it. Both and
    /// the bridge become one group. The offer is empty and `why_not` has the reason if there are sixteen bodies
    /// already, or if no body is near enough. Pre: no separation waits.   [worker]
    [[nodiscard]] Offer fusion(std::size_t held, const BodyStates& now, std::string& why_not);
    /// Returns an offer in which a cutting solid is removed from every present, cuttable body. `solid` is its number in
    /// records, `world_from_tool` the pose of its tool.   [worker]
    [[nodiscard]] Offer subtraction(std::uint16_t solid, const Pose& world_from_tool, const BodyStates& now) const;

    /// Returns an offer of the bodies for which `needs` is true, with all records committed. The scene does not change
    /// with it.   [worker]
    [[nodiscard]] Offer committed(const std::function<bool(std::size_t)>& needs) const;

    /// Makes the change that the loop has taken over. It does not use the offer's bodies, which the loop has exchanged.
    /// [worker]
    /// @param before         states of the bodies before the change
    /// @param next_sequence  for an undo or redo: `HapticLoop::next_sequence` after it
    void taken(const Offer& offer, const BodyStates& before, std::uint64_t next_sequence);

private:
    /// A separation that waits for the loop, and the owners after it. They are found when the separation is found, so
    /// that they do not depend on the tick of its takeover.
    struct Waiting {
        Separation separation;
        Owners owners;
        /// The cuts of those of its parts that later separations have changed, as they are without them. So an offer
        /// contains the same bone, whether a later separation has been found or not.
        std::map<std::uint16_t, CutField> without_later{};
    };
    /// A copy of everything that a change of bodies or a cut changes.
    struct Snapshot {
        BoneImage bone;
        BodyStates body_states;
        std::vector<Waiting> waiting;
        Owners owners;
    };
    void wait_for_the_loop(NewSeparation found);
    void stamp_waiting(const CutRecord& record);
    [[nodiscard]] Snapshot snapshot(const BodyStates& now) {
        return {bone_.image(), now, waiting_, belongings_.owners};
    }
    [[nodiscard]] static double removed_in(const BoneImage& bone) noexcept;  ///< removed volume [m³]
    void keep(Snapshot before);
    void push_undo_of(const BodyStates& before);
    void go(HistoryChange turn, const BodyStates& before, std::uint64_t next_sequence);
    [[nodiscard]] Offer addition(Offer::Change change, const Body& body, const BodyState& body_state,
                                 const BodyStates& now, std::string& why_not) const;
    [[nodiscard]] const std::vector<Snapshot>& snapshots(HistoryChange turn) const noexcept {
        return turn == HistoryChange::undo ? undo_ : redo_;
    }

    std::vector<const ToolSolid*> cutting_;
    BodyOwnership belongings_;
    PresentBone bone_;
    std::vector<std::uint64_t> next_;  ///< for each body: sequence number of its next record
    std::uint64_t removing_ = 0;       ///< number of all records applied so far
    std::vector<Waiting> waiting_;
    std::optional<Snapshot> before_cut_;  ///< state before the open cut; none: no cut is open
    BodyThreads threads_;                 ///< threads before the open or the next cut
    std::vector<Snapshot> undo_, redo_;
    std::vector<std::unique_ptr<Body>> grown_;  ///< the bone of all bridges that were offered
};

}  // namespace kerf
