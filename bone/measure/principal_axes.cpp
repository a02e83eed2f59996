// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::bone {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Rotates `m` in the plane of axes p and q, so that m[p][q] becomes zero; `v` collects the rotations in its columns.
void rotate_away(Matrix& m, Matrix& v, std::size_t p, std::size_t q) noexcept {
    if (m[p][q] == 0.0) return;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
    for (std::size_t k = 0; k < 3; ++k) {
        const double kp = m[k][p], kq = m[k][q];
        m[k][p] = c * kp - s * kq;
        m[k][q] = s * kp + c * kq;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double pk = m[p][k], qk = m[q][k];
        m[p][k] = c * pk - s * qk;
        m[q][k] = s * pk + c * qk;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double kp = v[k][p], kq = v[k][q];
        v[k][p] = c * kp - s * kq;
        v[k][q] = s * kp + c * kq;
    }
}

Vec3 with_sign(Vec3 axis) noexcept {
    double largest = axis.x;
    for (const double component : {axis.y, axis.z})
        if (std::abs(component) > std::abs(largest)) largest = component;
    return largest < 0.0 ? -axis : axis;
}

}  // namespace

PrincipalAxes principal_axes(std::span<const Vec3> points) noexcept {
    PrincipalAxes found{};
    for (const Vec3 p : points) found.centre = found.centre + p / static_cast<double>(points.size());
    Matrix m{}, v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const Vec3 p : points) {
        const Vec3 d = p - found.centre;
        const std::array<double, 3> at{d.x, d.y, d.z};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) m[i][j] += at[i] * at[j];
    }
    constexpr int sweeps = 12;  // each squares the off-diagonal remainder
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        rotate_away(m, v, 0, 1);
        rotate_away(m, v, 0, 2);
        rotate_away(m, v, 1, 2);
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return m[a][a] > m[b][b]; });
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t column = order[i];
        found.axes[i] = with_sign(normalized(Vec3{v[0][column], v[1][column], v[2][column]}));
        found.squares[i] = std::max(0.0, m[column][column]);
    }
    found.axes[2] = dot(cross(found.axes[0], found.axes[1]), found.axes[2]) < 0.0 ? -found.axes[2] : found.axes[2];
    return found;
}

}  // namespace kerf::bone
