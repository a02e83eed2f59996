// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "kerf/math.hpp"

namespace kerf {

/// Returns the rotation that takes the axes to these columns, or nothing if they are no right-handed unit axes within
/// 0.001: libraries of makers compute with single precision.   [any] pure
[[nodiscard]] std::optional<Quat> rotation_of_columns(Vec3 x, Vec3 y, Vec3 z) noexcept;

}  // namespace kerf
