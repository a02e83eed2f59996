// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kerf/math.hpp"

/// The isotropic grid of all fields of a body, divided into bricks of 8³ samples.
namespace kerf {

inline constexpr int brick_edge = 8;                ///< samples that a brick owns per axis
inline constexpr int stored_edge = brick_edge + 1;  ///< samples that it stores: its own and the next brick's first
inline constexpr int stored_samples = stored_edge * stored_edge * stored_edge;  ///< 729
/// Maximum number of bricks that one field can store. Indices of samples have 31 bits, and two more bricks are uniform
/// ones.
inline constexpr std::size_t max_stored_bricks = std::numeric_limits<std::int32_t>::max() / stored_samples - 2;
/// Stored distances are clamped to ± this many voxels.
inline constexpr double clamp_voxels = 4.0;

struct Grid {
    std::array<int, 3> bricks{};  ///< per axis
    double spacing = 0.0;         ///< [m]
    Vec3 origin{};                ///< of sample (0,0,0), body frame [m]

    [[nodiscard]] std::size_t brick_count() const noexcept {
        return static_cast<std::size_t>(bricks[0]) * static_cast<std::size_t>(bricks[1]) *
               static_cast<std::size_t>(bricks[2]);
    }
    [[nodiscard]] std::size_t brick_index(int i, int j, int k) const noexcept {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(bricks[1]) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(bricks[0]) +
               static_cast<std::size_t>(i);
    }
    /// Returns the coordinates of a brick along each axis.
    [[nodiscard]] std::array<int, 3> brick_coordinates(std::size_t index) const noexcept {
        const auto nx = static_cast<std::size_t>(bricks[0]), ny = static_cast<std::size_t>(bricks[1]);
        return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny), static_cast<int>(index / nx / ny)};
    }
    [[nodiscard]] int samples(std::size_t axis) const noexcept { return bricks[axis] * brick_edge; }
    [[nodiscard]] Vec3 sample_position(int i, int j, int k) const noexcept {
        return origin + spacing * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
    }
    [[nodiscard]] double clamp() const noexcept { return clamp_voxels * spacing; }
    /// Returns the size of one step of a stored distance [m]; clamp() is 32767 of them.
    [[nodiscard]] double quantum() const noexcept { return clamp() / 32767.0; }

    /// Returns a grid of whole bricks from `low` on that covers the box, with one brick to spare along each axis.
    /// Lengths in [m].
    static Grid covering(Vec3 low, Vec3 high, double spacing);
};

/// A point in the grid: its brick, its cell and the fractions [–] along the cell. `is_inside` is false outside the
/// grid; then no other member is valid.
struct LocatedPoint {
    bool is_inside = false;
    std::size_t brick = 0;
    int offset = 0;  ///< of the cell's low corner within the brick's 9³ samples
    float fx = 0, fy = 0, fz = 0;
};

/// Returns the number of fraction bits of fixed-point coordinates in voxels: as many as fit into 31 bits, at most the
/// 23 of a float. In a grid of 512 samples along an axis the resolution is 2e-7 voxels, a five-hundredth of a quantum.
[[nodiscard]] inline int fraction_bits(const Grid& grid) noexcept {
    const int longest = std::max({grid.samples(0), grid.samples(1), grid.samples(2), 1});
    return std::min(23, 31 - static_cast<int>(std::bit_width(static_cast<unsigned>(longest - 1))));
}

/// Returns the cell of a point, given by coordinates from the first sample in voxels times 2^bits. A coordinate between
/// −1 and 0 counts as 0.
[[nodiscard]] inline LocatedPoint locate_fixed(const Grid& grid, int bits, double gx, double gy, double gz) noexcept {
    const double one = static_cast<double>(std::int64_t{1} << bits);
    // NaN compares false: outside.
    const bool is_inside = gx > -1.0 && gy > -1.0 && gz > -1.0 && gx < grid.samples(0) * one &&
                           gy < grid.samples(1) * one && gz < grid.samples(2) * one;
    if (!is_inside) return {};
    const int x = static_cast<int>(gx), y = static_cast<int>(gy), z = static_cast<int>(gz);
    const int i = x >> bits, j = y >> bits, k = z >> bits, behind = (1 << bits) - 1;
    const auto fraction = [&](int v) { return static_cast<float>(v & behind) * static_cast<float>(1.0 / one); };
    LocatedPoint place;
    place.is_inside = true;
    place.brick = grid.brick_index(i / brick_edge, j / brick_edge, k / brick_edge);
    place.offset = ((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge;
    place.fx = fraction(x);
    place.fy = fraction(y);
    place.fz = fraction(z);
    return place;
}

[[nodiscard]] inline LocatedPoint locate(const Grid& grid, Vec3 p) noexcept {
    const int bits = fraction_bits(grid);
    const double one = static_cast<double>(std::int64_t{1} << bits), scale = one / grid.spacing;
    const double gx = (p.x - grid.origin.x) * scale;
    const double gy = (p.y - grid.origin.y) * scale;
    const double gz = (p.z - grid.origin.z) * scale;
    return locate_fixed(grid, bits, gx, gy, gz);
}

/// Returns the trilinear value of a brick's 9³ stored samples at a point. Computed in float: for integers up to 32767
/// the error is less than 0.01.
template <class Sample>
[[nodiscard]] inline float trilinear(const Sample* brick, const LocatedPoint& at) noexcept {
    constexpr int y = stored_edge, z = stored_edge * stored_edge;
    const Sample* v = brick + at.offset;
    const auto lerp = [](float a, float b, float t) { return a + (b - a) * t; };
    const float c00 = lerp(v[0], v[1], at.fx), c10 = lerp(v[y], v[y + 1], at.fx);
    const float c01 = lerp(v[z], v[z + 1], at.fx), c11 = lerp(v[z + y], v[z + y + 1], at.fx);
    return lerp(lerp(c00, c10, at.fy), lerp(c01, c11, at.fy), at.fz);
}

}  // namespace kerf
