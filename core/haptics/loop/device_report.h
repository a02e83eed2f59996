// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

#include "kerf/device.h"
#include "kerf/math.hpp"

/// Which reports of a device the loop uses. It treats others as those of a lost device.
namespace kerf {

inline constexpr double max_handle_distance = 5.0;  ///< [m] of a handle from the device's origin

/// Returns whether a pose is finite, near the device and has a unit quaternion.   [any] pure
[[nodiscard]] inline bool is_usable(const Pose& device_from_handle) noexcept {
    const Quat& q = device_from_handle.rotation;
    return is_finite(device_from_handle) && length(device_from_handle.position) < max_handle_distance &&
           std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 1e-3;
}

/// Returns whether a deflection is a fraction of its range.   [any] pure
[[nodiscard]] inline bool is_usable(const double (&deflection)[6]) noexcept {
    return std::all_of(std::begin(deflection), std::end(deflection), [](double d) { return std::abs(d) <= 1.0; });
}

}  // namespace kerf
