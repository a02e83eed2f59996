// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/haptics/law/body_threads.h"
#include "core/haptics/law/live_body.h"
#include "core/haptics/loop/owners.h"

/// Changes of bodies. They are made outside the haptic loop, and the loop takes them over between two ticks.
namespace kerf {

/// Pose and state of a body.
struct BodyState {
    Pose world_from_body = identity_pose();
    std::uint16_t group = 0;
    bool is_cuttable = true, is_present = true;

    [[nodiscard]] bool is_same_as(const BodyState& other) const noexcept;
};

/// States of all bodies, at the index of their id, and the screw threads in them, if known. A `SurfaceWorker` does not
/// know the screw threads, so an undo that it offers leaves them unchanged.
struct BodyStates {
    std::array<BodyState, max_bodies> of{};
    std::size_t count = 1;
    bool knows_threads = false;
    BodyThreads threads{};
};

/// Direction in the history of changes.
enum class HistoryChange { undo, redo };

/// One change of bodies. It is complete when it is offered, so the loop takes it over without allocating or waiting.
/// The loop leaves the replaced bodies in it, so that their owner destroys them outside the tick.
struct Offer {
    /// `committed`: the same bodies, with all records committed.
    enum class Change { none, separation, undo, redo, insertion, fusion, subtraction, committed };
    struct NewBody {
        std::unique_ptr<LiveBody> body;        ///< null: the loop keeps its body of this id
        std::optional<std::uint16_t> follows;  ///< id of the body whose pose and open stretch `body` takes over
        std::uint64_t through = 0;  ///< sequence number of the first record of `follows` that the field of `body` lacks
    };

    Change change = Change::none;
    std::uint64_t tick = 0;                ///< separation: tick of the record that separated the parent
    std::uint64_t removing = 0;            ///< undo, redo: number of bone-removing records so far when it was made
    std::array<NewBody, max_bodies> made;  ///< at the index of their id
    BodyStates body_states;                ///< after the change; a separation or subtraction sets `count` alone
    std::optional<Separation> separation;
    const Body* added = nullptr;        ///< insertion, fusion: bone of the new body, which has the last id
    std::vector<CutRecord> subtracted;  ///< the loop assigns their sequence numbers
    Owners owners;                      ///< after the change

    [[nodiscard]] bool is_any() const noexcept { return change != Change::none; }
    [[nodiscard]] bool is_history_change() const noexcept { return change == Change::undo || change == Change::redo; }
    /// Returns whether the loop closes its open stretches before it takes the offer over.
    [[nodiscard]] bool needs_closed_stretches() const noexcept {
        return is_history_change() || change == Change::subtraction;
    }
};

/// Returns an equal offer with bodies of its own, for another loop.   [main, worker]
/// Pre: no loop has taken the offer over.
[[nodiscard]] Offer copy_of(const Offer& offer);

}  // namespace kerf
