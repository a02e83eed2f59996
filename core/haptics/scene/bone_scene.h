// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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
    /// Finds new owners of the zones and steps of body `from`, which has split into `bodies`.
    using PassOn =
        std::function<void(Owners&, std::size_t from, const std::vector<std::size_t>& bodies, const PresentBone& bone)>;
    Owners owners;     ///< before any change
    PassOn inherit{};  ///< empty: owners never change
};

/// Applies cut records to the present bone and makes all changes of bodies. A change has two steps. The scene makes an
/// `Offer` and stays unchanged. After the haptic loop has taken the offer over, `taken` makes the same change here. One
/// thread uses it at a time: the loop's in lock-step, a worker's with a loop on the clock.
class BoneScene {
public:
    /// Maximum number of undo steps; the oldest is dropped.
    static constexpr std::size_t max_undo = 16;

    /// All bone of `body` is body 0. Pre: `body` and the cutting solids, in the order of the records' indices, outlive
    /// this object.   [main]
    BoneScene(const Body& body, std::vector<const ToolSolid*> cutting);
    /// Makes separated bone larger than `crumb` [m³] into bodies. Pre: no record has been applied. [main]
    void find_pieces(double crumb, BodyOwnership belongings = {});

    [[nodiscard]] const PresentBone& bone() const noexcept { return bone_; }
    [[nodiscard]] PresentBone& bone() noexcept { return bone_; }
    [[nodiscard]] const Owners& owners() const noexcept { return belongings_.owners; }

    /// Applies records in their order. `now` are the present states of the bodies.   [worker]
    void apply(std::span<const CutRecord> records, const BodyStates& now);
    /// Ends a cut when the tool touches no bone. If bone was removed since the last call, the cut becomes an undo step.
    /// [worker]
    void end_cut();
    /// Sets the threads while the tool touches no bone: undoing the next cut restores them.   [worker]
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

    /// Returns an offer of the first waiting separation. Pre: there is one.   [worker]
    [[nodiscard]] Offer separation() const;
    /// Returns an offer of all bodies before the last cut (undo), or after it (redo). Pre: `can(turn)`, and not in a
    /// cut.   [worker]
    [[nodiscard]] Offer turn(HistoryChange turn) const;
    /// Returns an offer of another body. `body` must outlive this object and the loop. A body that is not `cuttable`
    /// stops cutting tools. With sixteen bodies already, or other tissues than the bone's, the offer is empty and
    /// `why_not` has the reason. Pre: no separation waits.   [worker]
    [[nodiscard]] Offer insertion(const Body& body, const Pose& world_from_body, bool is_cuttable,
                                  const BodyStates& now, std::string& why_not) const;
    /// Returns an offer of a bone bridge between body `held` and the piece nearest to it, which become one group. With
    /// sixteen bodies already, or no piece near enough, the offer is empty and `why_not` has the reason. Pre: no
    /// separation waits.   [worker]
    [[nodiscard]] Offer fusion(std::size_t held, const BodyStates& now, std::string& why_not);
    /// Returns an offer in which the cutting solid at a pose is removed from every body.   [worker]
    [[nodiscard]] Offer subtraction(std::uint16_t solid, const Pose& world_from_tool, const BodyStates& now) const;

    /// Makes the change that the loop has taken over. The offer's live bodies are with the loop by then.
    /// @param before         states of the bodies before it
    /// @param next_sequence  number of the loop's next record: `HapticLoop::next_sequence`   [worker]
    void taken(const Offer& offer, const BodyStates& before, std::uint64_t next_sequence);

private:
    /// A separation that waits for the loop. Its owners are found at once: they must not depend on the time of the
    /// takeover.
    struct Waiting {
        Separation separation;
        Owners owners;
    };
    /// A snapshot of everything that a cut changes.
    struct Snapshot {
        BoneImage bone;
        BodyStates body_states;
        std::vector<Waiting> waiting;
        Owners owners;
    };
    void wait_for_the_loop(Separation separation);
    [[nodiscard]] Snapshot snapshot(const BodyStates& now) {
        return {bone_.image(), now, waiting_, belongings_.owners};
    }
    [[nodiscard]] static double removed_in(const BoneImage& bone) noexcept;  ///< [m³]
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
    std::vector<std::uint64_t> next_;  ///< for each body: number of its next record
    std::uint64_t removing_ = 0;       ///< number of records that removed bone
    std::vector<Waiting> waiting_;
    std::optional<Snapshot> before_cut_;  ///< before the present cut
    BodyThreads threads_;                 ///< before the present cut
    std::vector<Snapshot> undo_, redo_;
    std::vector<std::unique_ptr<Body>> grown_;  ///< bones of bridges
};

}  // namespace kerf
