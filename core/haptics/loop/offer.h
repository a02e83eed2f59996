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

/// Changes of bodies: made beside the haptic loop, taken over by it between two ticks.
namespace kerf {

/// Where a body is, and what it is to the tool.
struct Placing {
    Pose world_from_body = identity_pose();
    std::uint16_t group = 0;
    bool is_cuttable = true, is_present = true;

    [[nodiscard]] bool is_same_as(const Placing& other) const noexcept;
};

/// Of each body, at the index of its id; and the threads in them, if they are known. A worker beside a loop on the
/// clock is not told of threads: there an undo leaves them as they are.
struct Placings {
    std::array<Placing, most_bodies> of{};
    std::size_t count = 1;
    bool knows_threads = false;
    BodyThreads threads{};
};

/// Direction in the history of cuts.
enum class Turn { undo, redo };

/// One change of bodies. It is complete when it is offered, so that taking it over neither allocates nor waits. What it
/// replaces comes back in it.
struct Offer {
    enum class Change { none, separation, undo, redo, insertion, fusion, subtraction };
    struct Made {
        std::unique_ptr<LiveBody> body;        ///< null: the loop keeps its own
        std::optional<std::uint16_t> follows;  ///< body whose pose and open stretch it takes over
        std::uint64_t through = 0;             ///< first record of that body that its field does not hold
    };

    Change change = Change::none;
    std::uint64_t tick = 0;              ///< separation: of the record that parted the parent
    std::uint64_t removing = 0;          ///< undo, redo: records that had removed bone when it was made
    std::array<Made, most_bodies> made;  ///< at the index of their id
    Placings placings;                   ///< after it; of a separation and a subtraction only `count`. Threads are
                                         ///< those of undo and redo alone
    std::optional<Separation> separation;
    const Body* added = nullptr;        ///< insertion, fusion: bone of the last body
    std::vector<CutRecord> subtracted;  ///< the loop numbers them
    Owners owners;                      ///< after it

    [[nodiscard]] bool is_any() const noexcept { return change != Change::none; }
    [[nodiscard]] bool is_turn() const noexcept { return change == Change::undo || change == Change::redo; }
};

}  // namespace kerf
