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

/// The bone without lag and what happens to its bodies.
namespace kerf {

/// What belongs to bodies, and who inherits it.
struct Belongings {
    /// Finds new owners of the zones and steps that belonged to body `from`, which has become `bodies`.
    using PassOn =
        std::function<void(Owners&, std::size_t from, const std::vector<std::size_t>& bodies, const PresentBone& bone)>;
    Owners owners;     ///< before any change
    PassOn pass_on{};  ///< empty: owners never change
};

/// Applies cut records to the present bone and makes every change of bodies. A change is made in two steps: the scene
/// makes an `Offer` and stays as it is; once the haptic loop has taken the offer over, `taken` makes the same change
/// here. Belongs to one thread at a time: the loop's in lock-step, a worker's beside a loop on the clock.
class BoneScene {
public:
    /// Changes that can be taken back, at most; before that the oldest is forgotten.
    static constexpr std::size_t most_undo = 16;

    /// All of `body` is body 0. It and the cutting solids, as records number them, must outlive this.   [main]
    BoneScene(const Body& body, std::vector<const ToolSolid*> cutting);
    /// Makes bodies of bone that comes apart, if it is larger than `crumb` [m³]. Pre: nothing has been applied. [main]
    void look_for_pieces(double crumb, Belongings belongings = {});

    [[nodiscard]] const PresentBone& bone() const noexcept { return bone_; }
    [[nodiscard]] PresentBone& bone() noexcept { return bone_; }
    [[nodiscard]] const Owners& owners() const noexcept { return belongings_.owners; }

    /// Applies records, one after the other; `now`: where the bodies are.   [worker]
    void apply(std::span<const CutRecord> records, const Placings& now);
    /// The tool touches no bone: what was removed since it last did not is a cut, and can be taken back.   [worker]
    void leave_bone();
    /// These threads are in bone while the tool touches none: what the next cut is taken back to.   [worker]
    void know_threads(const BodyThreads& threads) noexcept { threads_ = threads; }
    /// What was done so far cannot be taken back any more.   [worker]
    void forget_changes() noexcept {
        undo_.clear();
        redo_.clear();
    }
    [[nodiscard]] bool is_in_a_cut() const noexcept { return begun_.has_value(); }
    [[nodiscard]] bool can(Turn turn) const noexcept { return !moments(turn).empty(); }

    /// The first separation that the loop has not taken over yet; null: none waits.
    [[nodiscard]] const Separation* waiting() const noexcept {
        return waiting_.empty() ? nullptr : &waiting_.front().separation;
    }

    /// Returns the first separation that waits. Pre: there is one.   [worker]
    [[nodiscard]] Offer separation() const;
    /// Returns all bodies as they were before the last cut, or after it. Pre: `can`, and not in a cut.   [worker]
    [[nodiscard]] Offer turn(Turn turn) const;
    /// Returns another body, which must outlive this and the loop; if it is not `cuttable`, it stops what would cut it.
    /// No change in the offer: the reason is in `why_not`. There are sixteen, or its tissues are others. Pre: nothing
    /// waits.   [worker]
    [[nodiscard]] Offer insertion(const Body& body, const Pose& world_from_body, bool is_cuttable, const Placings& now,
                                  std::string& why_not) const;
    /// Returns a bridge of bone between the body `held` and the piece nearest to it, which become one group. No change
    /// in the offer: as above. Pre: nothing waits.   [worker]
    [[nodiscard]] Offer fusion(std::size_t held, const Placings& now, std::string& why_not);
    /// Returns every body without what a cutting solid holds at a pose.   [worker]
    [[nodiscard]] Offer subtraction(std::uint16_t solid, const Pose& world_from_tool, const Placings& now) const;

    /// Makes the change that the loop has taken over. The bodies of the offer are gone by then.
    /// @param before         where the bodies were before it
    /// @param next_sequence  number of the loop's next record: `HapticLoop::next_sequence`   [worker]
    void taken(const Offer& offer, const Placings& before, std::uint64_t next_sequence);

private:
    /// A separation that waits. Its owners are found at once: they must not depend on when the loop takes it over.
    struct Waiting {
        Separation separation;
        Owners owners;
    };
    /// Everything that a cut changes.
    struct Moment {
        BoneImage bone;
        Placings placings;
        std::vector<Waiting> waiting;
        Owners owners;
    };
    void wait_for_the_loop(Separation separation);
    [[nodiscard]] Moment moment(const Placings& now) { return {bone_.image(), now, waiting_, belongings_.owners}; }
    [[nodiscard]] static double removed_in(const BoneImage& bone) noexcept;  ///< [m³]
    void keep(Moment before);
    void keep_for_undo(const Placings& before);
    void go(Turn turn, const Placings& before, std::uint64_t next_sequence);
    [[nodiscard]] Offer addition(Offer::Change change, const Body& body, const Placing& placing, const Placings& now,
                                 std::string& why_not) const;
    [[nodiscard]] const std::vector<Moment>& moments(Turn turn) const noexcept {
        return turn == Turn::undo ? undo_ : redo_;
    }

    std::vector<const ToolSolid*> cutting_;
    Belongings belongings_;
    PresentBone bone_;
    std::vector<std::uint64_t> next_;  ///< of each body: number of its first record not yet seen
    std::uint64_t removing_ = 0;       ///< records that removed bone
    std::vector<Waiting> waiting_;
    std::optional<Moment> begun_;  ///< what was before the cut that goes on
    BodyThreads threads_;          ///< before it
    std::vector<Moment> undo_, redo_;
    std::vector<std::unique_ptr<Body>> grown_;  ///< bridges
};

}  // namespace kerf
