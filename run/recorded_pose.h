// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf::run {

/// Removes −0, which SQLite does not store, so that a replay starts with the same bits.   [any] pure, nonblocking.
[[nodiscard]] inline Pose without_negative_zeros(const Pose& p) noexcept {
    return {{p.position.x + 0.0, p.position.y + 0.0, p.position.z + 0.0},
            {p.rotation.w + 0.0, p.rotation.x + 0.0, p.rotation.y + 0.0, p.rotation.z + 0.0}};
}

}  // namespace kerf::run
