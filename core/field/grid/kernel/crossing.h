// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>

#include "core/field/grid/kernel/block_kernel.h"

namespace kerf {

/// The change of a field along x, y, z from the sample before a sample to the one after it [quanta per two voxels].
struct SampleSlope {
    int along[3];
};

/// Returns the vertex on the edge of the grid from sample `at` of a brick to the next one along `axis`. The samples are
/// `low` and `high`: one is negative, the other not. Where the gradient is zero, the normal points outwards along the
/// edge.
[[nodiscard]] inline SurfaceVertex crossing(int low, int high, const SampleSlope& about_low,
                                            const SampleSlope& about_high, int axis, const int (&at)[3],
                                            const SampleFrame& frame) noexcept {
    SurfaceVertex vertex;
    const float to_low = static_cast<float>(std::abs(low)), to_high = static_cast<float>(std::abs(high));
    float slope[3];
    for (int n = 0; n < 3; ++n)
        slope[n] = to_high * static_cast<float>(about_low.along[n]) + to_low * static_cast<float>(about_high.along[n]);
    const float squared = (slope[0] * slope[0] + slope[1] * slope[1]) + slope[2] * slope[2];
    const float scale = 1.0f / std::sqrt(squared);
    for (int n = 0; n < 3; ++n)
        vertex.normal[n] = squared > 0.0f ? slope[n] * scale : n != axis ? 0.0f : low < 0 ? 1.0f : -1.0f;

    const float t = static_cast<float>(low) / static_cast<float>(low - high);
    for (int n = 0; n < 3; ++n) {
        const float sample = static_cast<float>(frame.first[n] + at[n]);
        vertex.position[n] = frame.origin[n] + frame.spacing * (n == axis ? sample + t : sample);
    }
    return vertex;
}

}  // namespace kerf
