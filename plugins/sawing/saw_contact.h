// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "own_slot.h"
#include "saw_cutting.h"

/// Where the saw touches without cutting: its sides always, its teeth as far as they do not cut.
namespace kerf::sawing {

/// As many contact channels as the law has room for, and friction for what the sides carried in the last tick [N].
/// [haptic, nonblocking]
void add_contact(const SawBlade& blade, const Tick& tick, const BoneQuery& bone, const Going& going, const OwnSlot& slot,
                 double last_binding, Channels& channels) noexcept;

/// What pressed on the blade's two sides together [N]: how hard it binds.   [haptic, nonblocking]
[[nodiscard]] double binding_of(const Advance& advance) noexcept;

}  // namespace kerf::sawing
