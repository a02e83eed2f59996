// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "core/haptics/law/guide_wall.h"
#include "core/haptics/law/held_body.h"
#include "core/haptics/loop/offer.h"

namespace kerf {

/// A change of a loop between two ticks. It is complete before the loop gets it, so the loop takes it over without
/// allocating or waiting, and leaves in it what it replaces.
struct LoopChange {
    std::optional<std::optional<Guide>> guide{};  ///< the sleeve from now on, or none; no value: unchanged
    Offer offer{};                                ///< of bodies
    bool removes_held = false;                    ///< the held body and all that is fused to it leave the scene
    std::optional<HeldPoints> held_points{};      ///< contact points of the held body
    std::optional<std::size_t> tool{};            ///< index of the tool to take
    Offer committed{};                            ///< spares the loop to commit records before it takes the tool
    double back = 0.0;                            ///< [m] distance by which it is moved back along its axis first

    [[nodiscard]] bool is_any() const noexcept {
        return guide || offer.is_any() || removes_held || held_points || tool;
    }
};

/// Whether a loop can take over an offer now.
enum class Takeover {
    possible,
    not_yet,   ///< an undo or redo waits until the stretch in the air is closed
    outdated,  ///< the bone has changed since the offer was made; a new offer is needed
    in_bone,   ///< an undo or redo needs a tool that is clear of bone
};

}  // namespace kerf
