// SPDX-License-Identifier: Apache-2.0
#include "devices/library/matrix_rotation.h"

#include <cmath>

namespace kerf {

std::optional<Quat> rotation_of_columns(Vec3 x, Vec3 y, Vec3 z) noexcept {
    constexpr double tolerance = 1e-3;
    if (!is_finite(x) || !is_finite(y) || !is_finite(z) || std::abs(length(x) - 1.0) > tolerance ||
        std::abs(length(y) - 1.0) > tolerance || std::abs(dot(x, y)) > tolerance ||
        length(cross(x, y) - z) > 10.0 * tolerance)
        return std::nullopt;
    Quat q;
    if (x.x + y.y + z.z > 0.0)
        q = {1.0 + x.x + y.y + z.z, y.z - z.y, z.x - x.z, x.y - y.x};
    else if (x.x >= y.y && x.x >= z.z)
        q = {y.z - z.y, 1.0 + x.x - y.y - z.z, x.y + y.x, z.x + x.z};
    else if (y.y >= z.z)
        q = {z.x - x.z, x.y + y.x, 1.0 - x.x + y.y - z.z, y.z + z.y};
    else
        q = {x.y - y.x, z.x + x.z, y.z + z.y, 1.0 - x.x - y.y + z.z};
    const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return Quat{q.w / norm, q.x / norm, q.y / norm, q.z / norm};
}

}  // namespace kerf
