// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "kerf/abi.h"

/// The arithmetic of block queries as a table of plain functions: written once for any machine, once for AVX2.
///
/// Both do the same operations on every point in the same order, so both give the same bits; which one a machine runs
/// changes how long it takes and nothing else. Here are only plain types and pointers: an inline function shared with a
/// file that is compiled for AVX2 could end up in a program for a machine without it. Pointers that belong together go
/// by reference: a copy of them, made with wider loads than they were stored with, would wait for those stores.
namespace kerf {

/// A change of coordinates as nine factors and an offset; `frame.h` applies it to one point.
struct Frame {
    kerf_vec3 x, y, z;  ///< b's axes in a
    kerf_vec3 origin;   ///< of b in a
};

/// The same in single precision.
struct SingleFrame {
    float axis[3][3], origin[3];
};

struct PointBox {
    double low[3], high[3];
};

/// Where a kernel reads or writes, coordinate by coordinate. All arrays a kernel is given have `block_capacity` places,
/// and it may write rubbish behind the last point; not so what plugins are told, which ends there.
struct ConstCoordinates {
    const double *x, *y, *z;
};
struct Coordinates {
    double *x, *y, *z;
};

/// What of a grid `place` needs. Coordinates: voxels times 2^bits, as `locate_fixed` has them.
struct Lattice {
    double low[3], high[3];  ///< points beyond are taken to the nearest between, if `is_bounded`
    std::uint32_t end[3];    ///< samples per axis times 2^bits
    int bits;
    bool is_bounded;
    std::int32_t row, layer;   ///< bricks along x, in a plane
    std::int32_t brick_count;  ///< also the number of the brick outside the grid
};
/// Outside the grid nothing but `brick` counts.
struct Places {
    std::int32_t *brick, *offset;
    float *x, *y, *z;  ///< [–] 0 … 1 from the low corner
};
struct ConstPlaces {
    const std::int32_t *brick, *offset;
    const float *x, *y, *z;
};

/// A field of distances as a kernel reads it: where each brick's 9³ samples begin, one entry more for what lies outside
/// the grid. Bricks that begin before `first_stored` hold one value everywhere: they begin at 0, or where those samples
/// end. Behind the last sample 16 bytes more may be read.
struct FieldShape {
    const std::int32_t* start;
    const std::int16_t* samples;
    std::int32_t first_stored;
    std::int32_t lowest;  ///< where the brick begins that is deep in bone, or uncut, everywhere
};
struct Slopes {
    float *value, *x, *y, *z;  ///< [quanta], and per voxel
};
struct ConstSlopes {
    const float *value, *x, *y, *z;
};
/// What makes an answer of a slope.
struct Surface {
    double quantum, clamp;  ///< [m]
    float in_tool[3][3];    ///< the grid's axes in the tool frame
};

/// What edges are told, each figure for all of them. Of tissues from `tissues` on: no share, no density.
struct SampleColumns {
    const float* engagement;        ///< [–] 0 … 1
    const double* gap;              ///< [m]
    const float *weight, *density;  ///< [–], [kg/m³], of tissue m from m · `stride` on
    std::size_t stride, tissues;
    std::int32_t body;
};

/// A slab across the axis in which a solid is not: half of its thickness, and its middle [m].
struct OutlineGap {
    double half, middle;
};
struct SingleGap {
    float half, middle;
};
inline constexpr std::size_t max_gaps = KERF_MAX_GAPS;

/// From one outline point to the next, in the half plane (r, z): r = √(x² + y²) of a solid of revolution, |x| of a
/// prism.
struct OutlineSegment {
    double along_r, along_z, inverse_length2;
    double slope;                       ///< [–] how the radius grows backwards
    double normal_r, normal_z, offset;  ///< of its line: normal_r r + normal_z z = offset; unit, outwards
};
/// An outline from the tip backwards, `count` points and `count − 1` segments.
struct OutlineShape {
    const kerf_profile_point* point;
    const OutlineSegment* segment;
    std::size_t count;
    double largest_radius;  ///< [m]
    bool is_convex;
    double half_thickness;  ///< [m] of a prism, which is convex; 0: a solid of revolution
    double bore;            ///< [m] radius of the bore through a hollow solid, which is not convex; 0: none
    const OutlineGap* gap;  ///< of a solid in several parts, which is not convex
    std::size_t gaps;
};

/// The same in single precision, for samples and for many solids at once.
struct OutlineFace {
    float radius, z;  ///< where it begins
    float along_r, along_z, inverse_length2, slope;
    float normal_r, normal_z, offset;
};
struct SingleOutline {
    const OutlineFace* face;
    std::size_t count;
    float front_radius, front_z, back_radius, back_z;
    bool is_convex;
    float half_thickness;  ///< [m] of a prism, which is convex; 0: a solid of revolution
    float bore;            ///< [m] radius of the bore through a hollow solid, which is not convex; 0: none
    const SingleGap* gap;  ///< of a solid in several parts, which is not convex
    std::size_t gaps;
};

/// Samples of a brick: three layers of three rows of nine. Sample (x, y, z) of them lies, in the tool frame [m], at
///
///     ((origin + (first[0] + x) along[0]) + (first[1] + y) along[1]) + (first[2] + z) along[2]
///
/// counted from one sample of the grid for all bricks, so that what two of them share lies at one place.
struct SampleCell {
    float origin[3], along[3][3], first[3];
    bool has_edges;  ///< whether any of them may be outside and nearer to an edge of the outline than to a face
};

/// What `deepest` finds.
struct Walls {
    float* depth;         ///< [m]
    std::int32_t* which;  ///< of the solids
    float *x, *y, *z;     ///< the way in, in the frame of the points; where the depth is not negative
};

/// Samples −1 … 9 of a brick along each axis, as the surface of its cells needs them: at a *place* each, which is
/// (x + 1) | (y + 1) << 4 | (z + 1) << 8.
inline constexpr int place_row = 16, place_layer = 256;
/// Where the 9³ samples begin of a brick and of its neighbours at −x, +x, −y, +y, −z, +z; of a uniform brick too.
struct BrickAround {
    const std::int16_t *own, *beside[6];
};
/// A vertex of a surface.
struct SurfaceVertex {
    float position[3];  ///< [m] body frame
    float normal[3];    ///< unit, outwards
};
/// Where the samples of a brick lie: origin + spacing (first + (x, y, z)).
struct SampleFrame {
    float origin[3], spacing;  ///< [m]
    std::int32_t first[3];     ///< of its own samples, counted from the grid's
};

struct BlockKernel {
    const char* name;

    /// As pose · point.
    void (*transform)(const kerf_pose& a_from_b, std::size_t count, const ConstCoordinates& in_b,
                      const Coordinates& in_a) noexcept;
    /// As frame · point.
    void (*move)(const Frame& a_from_b, std::size_t count, const kerf_vec3* in_b, const Coordinates& in_a) noexcept;
    /// As `locate_fixed` of frame · point. Tells, where it is asked for, the box the points lie in, as they were given;
    /// that of a NaN is anything.
    void (*place)(const Frame& fixed_from_points, const Lattice& grid, std::size_t count, const kerf_vec3* points,
                  const Places& places, PointBox* box) noexcept;
    /// As `trilinear` [quanta].
    void (*values)(const FieldShape& field, std::size_t count, const ConstPlaces& places, float* values) noexcept;
    /// The same in metres, those of uniform bricks ± `clamp` exactly.
    void (*metres)(const FieldShape& field, std::size_t count, const ConstPlaces& places, double quantum, double clamp,
                   double* values) noexcept;
    /// As `trilinear` of floats; `elsewhere` in bricks that begin at −1.
    void (*densities)(const std::int32_t* start, const float* samples, std::size_t count, const ConstPlaces& places,
                      float elsewhere, float* values) noexcept;
    /// The larger of two fields, with its gradient. Returns the least of them.
    float (*slopes)(const FieldShape& bone, const FieldShape& cut, std::size_t count, const ConstPlaces& places,
                    const Slopes& larger) noexcept;
    /// What a contact is told: distance, and where a surface is in reach its normal.
    void (*answer)(const Surface& surface, std::size_t count, const ConstSlopes& slopes,
                   kerf_surface_point* answers) noexcept;
    /// Row by row what columns hold.
    void (*rows)(const SampleColumns& columns, std::size_t count, kerf_bone_sample* samples) noexcept;
    /// As minus `ToolSolid::distance` [m], points in the tool frame.
    void (*depths)(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
                   double* depths) noexcept;
    /// A plane each that a convex solid does not cross: near a point nothing is deeper than
    /// depth + gradient · (from the point) [m], [–].
    void (*tangents)(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths,
                     const Coordinates& gradients) noexcept;
    /// The deepest of the same solid at several places, in single precision: where a point is deeper in one of them
    /// than `walls.depth` has it, in which, and which way is in.
    void (*deepest)(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids,
                    std::size_t count, const kerf_vec3* points, const Walls& walls) noexcept;
    /// As `sample = max(sample, depth)` [quanta], rounded, where a sample is at most `band` [m] outside; `samples`: the
    /// cell's first. Tells whether any was raised, and if so in which range they are then. `spare` [quanta], if it is
    /// asked for: were the solid deeper by less everywhere, still none would be raised that was not; kernels need not
    /// agree in it.
    bool (*raise)(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum,
                  std::int16_t* samples, std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept;
    /// Which of the 27 samples of each of a cell's layers are within low … high: bit by bit.
    void (*find)(const std::int16_t* samples, std::int16_t low, std::int16_t high, std::uint32_t (&found)[3]) noexcept;
    /// The larger of two fields at samples 0 … 8 of a brick along y and z, −1 … 9 along x, to `samples[place]`. Bit x +
    /// 1 of `inside[place >> 4]` says which of samples 0 … 8 of a row are negative.
    void (*larger_rows)(const BrickAround& a, const BrickAround& b, std::int16_t* samples,
                        std::uint16_t* inside) noexcept;
    /// The same at samples −1 and 9 along y and z, 0 … 8 along the other axes.
    void (*larger_beside)(const BrickAround& a, const BrickAround& b, std::int16_t* samples) noexcept;
    /// Where a field, linear along the grid's edge from each place along `axis`, is zero, and which way it rises there,
    /// by central differences at both ends. Reads up to seven places behind the last and writes as many vertices, and
    /// eight bytes more. Pre: one end negative, the other not.
    void (*crossings)(const std::int16_t* samples, const std::uint16_t* places, std::size_t count, int axis,
                      const SampleFrame& frame, SurfaceVertex* vertices) noexcept;
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
