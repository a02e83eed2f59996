// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "printed_drill.h"

/// Touch by counting, as [tsai-2007] prints it, section 4.
namespace kerf::as_printed {

/// So many newtons for each surface point inside bone, against the way the drill moves. As printed: a drill that rests
/// feels nothing, and one that is withdrawn is held back (E00-6); more points are more force (P6).
struct TouchCount {
    using State = LastInterval;
    enum Parameter : std::size_t { per_point, voxel_width, shank, force_parameter_count };
    enum Signal : std::size_t { immersed, signal_count };
    static constexpr std::size_t drive_count = as_printed::drive_count;

    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept;
    static void commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                       std::span<double> signals, Actions& actions) noexcept;
};
static_assert(ForceLaw<TouchCount>);

}  // namespace kerf::as_printed
