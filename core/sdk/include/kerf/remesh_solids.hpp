// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kerf/remesh.h"

namespace kerf::remeshing {

using Profile = std::span<const kerf_profile_point>;

/// Returns the parts of an outline along which a solid of revolution is convex; neighbours have one point in common.
/// The solid is the union of the solids of its parts.   Pre: at least two points, z falls.   [any] pure.
[[nodiscard]] inline std::vector<Profile> convex_runs(Profile profile) {
    std::vector<Profile> runs;
    std::size_t first = 0;
    const auto slope = [&](std::size_t i) {  // of the outline from point i to the next, away from the tip
        return (profile[i + 1].radius - profile[i].radius) / (profile[i].z - profile[i + 1].z);
    };
    for (std::size_t i = 1; i + 1 < profile.size(); ++i)
        if (slope(i) > slope(i - 1)) {
            runs.push_back(profile.subspan(first, i - first + 1));
            first = i;
        }
    runs.push_back(profile.subspan(first));
    return runs;
}

}  // namespace kerf::remeshing
