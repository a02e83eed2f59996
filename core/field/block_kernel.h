// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "kerf/abi.h"

/// The arithmetic of block queries as a table of plain functions: written once for any machine, once for AVX2.
///
/// Both do the same operations on every point in the same order, so both give the same bits; which one a machine runs
/// changes how long it takes and nothing else. Here are only plain types and pointers: an inline function shared with a
/// file that is compiled for AVX2 could end up in a program for a machine without it.
namespace kerf {

/// Where a kernel reads or writes, coordinate by coordinate. All arrays a kernel is given have `block_capacity` places,
/// and it may write rubbish behind the last point.
struct ConstCoordinates {
    const double *x, *y, *z;
};
struct Coordinates {
    double *x, *y, *z;
};

/// What of a grid `locate` needs.
struct LatticeShape {
    double origin[3], spacing;  ///< [m]
    double samples[3];          ///< per axis
    std::int32_t row, column;   ///< bricks along x, along y
};
struct Places {
    std::int32_t *brick, *offset;
    Coordinates fraction;
};

/// From one outline point to the next, in the half plane (r, z).
struct OutlineSegment {
    double along_r, along_z, inverse_length2;
    double slope;  ///< [–] how the radius grows backwards
    double normal_r, normal_z, offset;  ///< of its line: normal_r r + normal_z z = offset; unit, outwards
};
/// An outline from the tip backwards, `count` points and `count − 1` segments.
struct OutlineShape {
    const kerf_profile_point* point;
    const OutlineSegment* segment;
    std::size_t count;
    double largest_radius;  ///< [m]
    bool is_convex;
};

/// Some of a brick's samples in three layers, three neighbouring rows of each.
struct SampleCell {
    ConstCoordinates row;    ///< where the layers' nine rows each would begin at x = 0, tool frame [m]
    ConstCoordinates along;  ///< from there to the nine samples of a row [m]
    int first_x, last_x;     ///< 4 or 5 of each row
    int first_y;
    /// No sample of the cell is deeper than base + x per_x + y per_y + layer per_layer, x and y counted in the brick
    /// [quanta], give or take one for rounding.
    float base, per_x, per_y, per_layer;
};

struct BlockKernel {
    const char* name;

    /// As pose · point.
    void (*transform)(const kerf_pose& a_from_b, std::size_t count, ConstCoordinates in_b, Coordinates in_a) noexcept;
    /// As `locate` of one point.
    void (*locate)(const LatticeShape& grid, std::size_t count, ConstCoordinates points, Places places) noexcept;
    /// As `trilinear` of one point, times `quantum`. `corner`: each point's low corner among its brick's 9³ samples.
    void (*trilinear_int16)(const std::int16_t* const* corner, std::size_t count, ConstCoordinates fraction,
                            double quantum, double* values) noexcept;
    void (*trilinear_float)(const float* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
                            double* values) noexcept;
    /// The same value, and its gradient per voxel, not scaled: from the same eight samples.
    void (*gradient_int16)(const std::int16_t* const* corner, std::size_t count, ConstCoordinates fraction,
                           double quantum, double* values, Coordinates gradient) noexcept;
    /// As rotate(a_from_b, normalized(v)).
    void (*unit)(const kerf_quat& a_from_b, std::size_t count, ConstCoordinates in_b, Coordinates in_a) noexcept;
    /// As minus `RevolutionSolid::distance` [m], points in the tool frame.
    void (*depths)(const OutlineShape& outline, std::size_t count, ConstCoordinates in_tool, double* depths) noexcept;
    /// A plane each that a convex solid does not cross: near a point nothing is deeper than
    /// depth + gradient · (from the point) [m], [–].
    void (*tangents)(const OutlineShape& outline, std::size_t count, ConstCoordinates in_tool, double* depths,
                     Coordinates gradients) noexcept;
    /// As `sample = max(sample, quantised(depth))` where a sample is at most `band` [m] outside; `samples`: the layers'
    /// 3 × 9 × 9. Tells whether any was raised, and in which range they are then.
    bool (*raise)(const OutlineShape& outline, const SampleCell& cell, double band, double quantum, std::int16_t* samples,
                  std::int16_t& lowest, std::int16_t& highest) noexcept;
};

/// For any machine.
[[nodiscard]] const BlockKernel& portable_kernel() noexcept;
/// Null where the machine or the compiler has no AVX2.
[[nodiscard]] const BlockKernel* avx2_kernel() noexcept;

/// What queries and stamps use: the fastest for this machine.   [any] nonblocking.
[[nodiscard]] const BlockKernel& block_kernel() noexcept;
/// The same with another kernel from now on, in the whole process: for tests and benchmarks that compare two.   [main]
void use_block_kernel(const BlockKernel& kernel) noexcept;

}  // namespace kerf
