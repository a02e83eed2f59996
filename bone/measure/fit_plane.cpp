// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/fit_plane.h"

#include <algorithm>
#include <cmath>

#include "bone/measure/principal_axes.h"

namespace kerf::bone {
namespace {

constexpr double min_spread = 1e-9;  // [m] below it all points coincide

double degrees_left(std::size_t points, std::size_t fitted) noexcept {
    return points > fitted ? static_cast<double>(points - fitted) : 0.0;
}

}  // namespace

std::optional<FittedLine> line_through(std::span<const Vec3> points) noexcept {
    if (points.size() < 2) return std::nullopt;
    const PrincipalAxes found = principal_axes(points);
    if (!(found.squares[0] > min_spread * min_spread)) return std::nullopt;
    const Vec3 chord = points.back() - points.front();
    FittedLine fitted{{found.centre, dot(chord, found.axes[0]) < 0.0 ? -found.axes[0] : found.axes[0]}, 0.0};
    if (const double left = degrees_left(points.size(), 2); left > 0.0)  // per transverse direction
        fitted.residual = std::sqrt((found.squares[1] + found.squares[2]) / (2.0 * left));
    return fitted;
}

std::optional<FittedPlane> plane_through(std::span<const Vec3> points) noexcept {
    if (points.size() < 3) return std::nullopt;
    const PrincipalAxes found = principal_axes(points);
    if (!(found.squares[1] > min_spread * min_spread)) return std::nullopt;
    const Vec3 sense = cross(points[1] - points[0], points[2] - points[0]);
    FittedPlane fitted{{found.centre, dot(sense, found.axes[2]) < 0.0 ? -found.axes[2] : found.axes[2]}, 0.0, 0.0};
    if (const double left = degrees_left(points.size(), 3); left > 0.0) {
        fitted.residual = std::sqrt(found.squares[2] / left);
        fitted.tilt_uncertainty = fitted.residual / std::sqrt(found.squares[1]);
    }
    return fitted;
}

std::optional<FittedPlane> mirror_plane(std::span<const Vec3> left, std::span<const Vec3> right) noexcept {
    const std::size_t pairs = std::min(left.size(), right.size());
    if (pairs == 0) return std::nullopt;
    const double count = static_cast<double>(pairs);
    Vec3 sum{}, middle{};
    for (std::size_t i = 0; i < pairs; ++i) {
        sum = sum + (left[i] - right[i]);
        middle = middle + 0.5 / count * (left[i] + right[i]);
    }
    if (!(length(sum) > min_spread)) return std::nullopt;
    FittedPlane fitted{{middle, normalized(sum)}, 0.0, 0.0};
    if (pairs < 2) return fitted;
    double off = 0.0, across = 0.0;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double d = dot(0.5 * (left[i] + right[i]) - middle, fitted.plane.normal);
        const Vec3 chord = left[i] - right[i], aside = chord - dot(chord, fitted.plane.normal) * fitted.plane.normal;
        off += d * d;
        across += dot(aside, aside);
    }
    fitted.residual = std::sqrt(off / (count - 1.0));
    fitted.tilt_uncertainty = std::sqrt(across / (count - 1.0)) / (length(sum) / count) / std::sqrt(count);
    return fitted;
}

}  // namespace kerf::bone
