// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/haptics/live_body.h"

/// The bone without lag, what has come apart in it, and what it was before each cut.
namespace kerf {

/// Where a body is, and what it is to the tool.
struct Placing {
    Pose world_from_body = identity_pose();
    std::uint16_t group = 0;
    bool is_cuttable = true, is_present = true;

    [[nodiscard]] bool is_same_as(const Placing& other) const noexcept;
};

/// Of each body, at the place of its id.
struct Placings {
    std::array<Placing, most_bodies> of{};
    std::size_t count = 1;
};

/// Which way in the history of cuts.
enum class Turn { undo, redo };

/// All bodies as they were at another time, made beforehand, so that taking them over neither allocates nor waits. What
/// they replace goes back in their place.
struct Restoration {
    Turn turn = Turn::undo;
    std::uint64_t records = 0;  ///< that had removed bone when it was made
    Placings placings;
    std::vector<std::unique_ptr<LiveBody>> bodies;  ///< with room for all there may be
};

/// Either the loop has one, in lock-step, or the worker beside it. Belongs to one thread at a time.
class PresentScene {
public:
    /// Changes that can be taken back, at most; before that the oldest is forgotten.
    static constexpr std::size_t most_undo = 16;

    /// All of `body` is body 0. It and the cutting solids, as records number them, must outlive this.   [main]
    PresentScene(const Body& body, std::vector<const ToolSolid*> cutting);

    [[nodiscard]] const PresentBone& bone() const noexcept { return bone_; }
    [[nodiscard]] PresentBone& bone() noexcept { return bone_; }

    /// Stamps records, one after the other; `now`: where the bodies are.   [worker]
    void apply(std::span<const CutRecord> records, const Placings& now);
    /// The tool touches no bone: what was removed since it last did not is a cut, and can be taken back.   [worker]
    void leave_bone();
    [[nodiscard]] bool is_in_a_cut() const noexcept { return begun_.has_value(); }
    /// Before a change that is no cut.   [worker]
    void keep_for_undo(const Placings& now);

    /// What came apart and the loop does not know of.
    [[nodiscard]] const std::vector<Separation>& waiting() const noexcept { return waiting_; }
    /// The first of these is known to the loop from now on.   [worker]
    Separation take_adopted();

    [[nodiscard]] bool can(Turn turn) const noexcept { return !moments(turn).empty(); }
    /// What going there would bring. Pre: `can`, and not in a cut.   [worker]
    [[nodiscard]] Restoration restoration(Turn turn) const;
    /// The loop's bodies for the first separation that waits, which hold all of the parent's records before `through`.
    /// [worker]
    [[nodiscard]] Adoption adoption(std::uint64_t through) const {
        return adoption_of(waiting_.front(), bone_, *cutting_.front(), through);
    }
    /// Goes there: the bone to the bit, and what waits.   [worker] Pre: as above.
    void go(Turn turn, const Placings& now);

private:
    /// Everything that a cut changes.
    struct Moment {
        BoneImage bone;
        Placings placings;
        std::vector<Separation> waiting;
    };
    [[nodiscard]] Moment moment(const Placings& now) { return {bone_.image(), now, waiting_}; }
    [[nodiscard]] static double removed_in(const BoneImage& bone) noexcept;  ///< [m³]
    void keep(Moment before);
    [[nodiscard]] const std::vector<Moment>& moments(Turn turn) const noexcept {
        return turn == Turn::undo ? undo_ : redo_;
    }

    std::vector<const ToolSolid*> cutting_;
    PresentBone bone_;
    std::vector<Separation> waiting_;
    std::optional<Moment> begun_;  ///< what was before the cut that goes on
    std::vector<Moment> undo_, redo_;
};

}  // namespace kerf
