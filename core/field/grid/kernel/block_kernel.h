// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "kerf/abi.h"

/// The arithmetic of block queries as a table of functions, with one version for any machine and one for AVX2.
///
/// Both versions do the same operations on every point in the same order, so both give the same bits; they differ only
/// in speed. This header has plain types and pointers alone: an inline function that is also compiled for AVX2 could
/// end up in a program for a machine without it. Groups of pointers are passed by reference: a copy would be loaded
/// with wider instructions than its stores, and would wait for those stores.
namespace kerf {

/// A coordinate transform from frame b to a, of nine factors and an offset. `frame.h` applies it to one point.
struct Frame {
    kerf_vec3 x, y, z;  ///< b's axes in a, with the scale
    kerf_vec3 origin;   ///< of b in a
};

/// A coordinate transform in single precision.
struct SingleFrame {
    float axis[3][3], origin[3];
};

struct PointBox {
    double low[3], high[3];
};

/// Coordinates that a kernel reads or writes, one array each. Each array passed to a kernel has `block_capacity`
/// elements, and the kernel may write arbitrary values after the last point. Arrays that plugins read are exact: they
/// end with the last point.
struct ConstCoordinates {
    const double *x, *y, *z;
};
struct Coordinates {
    double *x, *y, *z;
};

/// The part of a grid that locates points. Coordinates: voxels times 2^bits, as in `locate_fixed`.
struct Lattice {
    double low[3], high[3];  ///< region; if `is_bounded`, a point outside moves to its nearest point
    std::uint32_t end[3];    ///< samples per axis times 2^bits
    int bits;
    bool is_bounded;
    std::int32_t row, layer;   ///< bricks along x, and in a layer of x and y
    std::int32_t brick_count;  ///< also the index of the brick outside the grid
};
/// Cells of points, one array per member. Outside the grid only `brick` is valid.
struct LocatedArrays {
    std::int32_t *brick, *offset;
    float *x, *y, *z;  ///< [–] 0 … 1 from the low corner
};
struct ConstLocatedArrays {
    const std::int32_t *brick, *offset;
    const float *x, *y, *z;
};

/// A field of distances as a kernel reads it: the first of each brick's 9³ samples, with one more entry for the outside
/// of the grid. Bricks that begin before `first_stored` are uniform: they begin at 0 or at 729, after the first uniform
/// brick. 16 bytes may be read after the last sample.
struct FieldShape {
    const std::int32_t* start;
    const std::int16_t* samples;
    std::int32_t first_stored;
    std::int32_t lowest;  ///< first sample of the uniform brick of −32767: deep in bone, or uncut
};
struct Slopes {
    float *value, *x, *y, *z;  ///< [quanta], and per voxel
};
struct ConstSlopes {
    const float *value, *x, *y, *z;
};
/// Constants that convert a slope to an answer.
struct Surface {
    double quantum, clamp;  ///< [m]
    float in_tool[3][3];    ///< the grid's axes in the tool frame
};

/// Samples for edges, one array per value. Tissues with the number `tissues` or above get weight and density 0.
struct SampleColumns {
    const float* engagement;        ///< [–] 0 … 1
    const double* gap;              ///< [m]
    const float *weight, *density;  ///< [–], [kg/m³]; those of tissue m begin at m · `stride`
    std::size_t stride, tissues;
    std::int32_t body;
};

/// A gap of a solid across its axis: half of its thickness, and its middle [m].
struct OutlineGap {
    double half, middle;
};
struct SingleGap {
    float half, middle;
};
inline constexpr std::size_t max_gaps = KERF_MAX_GAPS;

/// A segment from one outline point to the next, in the half plane (r, z): r = √(x² + y²) for a solid of revolution,
/// |x| for a prism.
struct OutlineSegment {
    double along_r, along_z, inverse_length2;
    double slope;                       ///< [–] growth of the radius along −z
    double normal_r, normal_z, offset;  ///< of its line normal_r r + normal_z z = offset; unit normal, outwards
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

/// A segment of an outline in single precision, for samples and for many solids at once.
struct OutlineFace {
    float radius, z;  ///< start point of the segment
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

/// Cell of a brick: samples in three layers of three rows of nine. Its sample (x, y, z) lies, in the tool frame [m], at
///
///     ((origin + (first[0] + x) along[0]) + (first[1] + y) along[1]) + (first[2] + z) along[2]
///
/// For all bricks, `first` counts from the same sample of the grid. So a sample that belongs to two bricks has the same
/// position in both.
struct SampleCell {
    float origin[3], along[3][3], first[3];
    bool has_edges;  ///< true if a sample may lie outside, nearer to an edge of the outline than to a face
};

/// Arguments and results of `deepest`, one array element per point.
struct Walls {
    float* depth;         ///< [m]
    std::int32_t* which;  ///< index of the solid
    float *x, *y, *z;     ///< inward direction, in the frame of the points; valid where the depth is not negative
};

/// The surface in the cells of a brick needs its samples −1 … 9 along each axis. The *slot* of sample (x, y, z) is its
/// index in their array: (x + 1) | (y + 1) << 4 | (z + 1) << 8.
inline constexpr int slot_row = 16, slot_layer = 256;
/// The first of the 9³ samples of a brick and of its neighbours at −x, +x, −y, +y, −z, +z; also for a uniform brick.
struct BrickAround {
    const std::int16_t *own, *neighbour[6];
};
/// A vertex of a surface.
struct SurfaceVertex {
    float position[3];  ///< [m] body frame
    float normal[3];    ///< unit, outwards
};
/// Positions of a brick's samples, body frame: origin + spacing (first + (x, y, z)).
struct SampleFrame {
    float origin[3], spacing;  ///< [m]
    std::int32_t first[3];     ///< of the brick's first own sample, in samples of the grid
};

struct BlockKernel {
    const char* name;

    /// Writes pose · point for a block of points.
    void (*transform)(const kerf_pose& a_from_b, std::size_t count, const ConstCoordinates& in_b,
                      const Coordinates& in_a) noexcept;
    /// Writes frame · point for a block of points.
    void (*move)(const Frame& a_from_b, std::size_t count, const kerf_vec3* in_b, const Coordinates& in_a) noexcept;
    /// Writes `locate_fixed` of frame · point, moved into the region. If `box` is not null, also writes the bounding
    /// box of the points in their own frame; the box is arbitrary if a coordinate is NaN.
    void (*place)(const Frame& fixed_from_points, const Lattice& grid, std::size_t count, const kerf_vec3* points,
                  const LocatedArrays& places, PointBox* box) noexcept;
    /// Writes `trilinear` [quanta].
    void (*values)(const FieldShape& field, std::size_t count, const ConstLocatedArrays& places,
                   float* values) noexcept;
    /// Writes `trilinear` [m]; values of uniform bricks are exactly ± `clamp`.
    void (*metres)(const FieldShape& field, std::size_t count, const ConstLocatedArrays& places, double quantum,
                   double clamp, double* values) noexcept;
    /// Writes `trilinear` of floats; `elsewhere` in bricks whose `start` is −1.
    void (*densities)(const std::int32_t* start, const float* samples, std::size_t count,
                      const ConstLocatedArrays& places, float elsewhere, float* values) noexcept;
    /// Writes, per point, the larger of two fields and its gradient. Returns the smallest value written [quanta].
    float (*slopes)(const FieldShape& bone, const FieldShape& cut, std::size_t count, const ConstLocatedArrays& places,
                    const Slopes& larger) noexcept;
    /// Writes the answers of a contact query: the distance [m] and, if it is within the clamp, the normal in the tool
    /// frame and body 0. Else the normal is zero and the body −1.
    void (*answer)(const Surface& surface, std::size_t count, const ConstSlopes& slopes,
                   kerf_surface_point* answers) noexcept;
    /// Writes the columns as rows.
    void (*rows)(const SampleColumns& columns, std::size_t count, kerf_bone_sample* samples) noexcept;
    /// Writes minus `ToolSolid::distance` [m] of points in the tool frame.
    void (*depths)(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
                   double* depths) noexcept;
    /// Writes for each point its depth [m] below a plane that a convex solid does not cross, and the gradient [–] of
    /// this depth. At any offset from the point, the depth in the solid is at most depth + gradient · offset.
    void (*tangents)(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths,
                     const Coordinates& gradients) noexcept;
    /// Compares each point with a solid at several poses, in single precision. If its depth at any pose exceeds
    /// `walls.depth`, writes the largest depth, the index of its pose, and the inward direction there.
    void (*deepest)(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids,
                    std::size_t count, const kerf_vec3* points, const Walls& walls) noexcept;
    /// Sets each of a cell's samples to max(sample, depth) [quanta], rounded, unless it is more than `band` [m]
    /// outside. `samples` points to the cell's first. Returns whether any sample was raised, and if so writes the range
    /// of the cell's samples. If `spare` is not null, writes 0 if a sample was raised. Else it writes a depth [quanta]:
    /// if the solid were deeper everywhere by less than this, still no sample would rise. Kernels may differ in
    /// `spare`.
    bool (*raise)(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum,
                  std::int16_t* samples, std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept;
    /// Finds the samples of a SampleCell within low … high, both included. Bit n of `found[layer]` is for sample n of
    /// the 27 of a layer: rows of nine, x fastest.
    void (*find)(const std::int16_t* samples, std::int16_t low, std::int16_t high, std::uint32_t (&found)[3]) noexcept;
    /// Writes the larger of two fields to `samples[slot]`: samples −1 … 9 of a brick along x, 0 … 8 along y and z. Bit
    /// x + 1 of `inside[slot >> 4]` is 1 if sample x of the row, 0 … 8, is negative.
    void (*larger_rows)(const BrickAround& a, const BrickAround& b, std::int16_t* samples,
                        std::uint16_t* inside) noexcept;
    /// Writes the larger of two fields beyond four sides of a brick: at samples −1 and 9 along y, and along z, each
    /// with samples 0 … 8 along the other two axes.
    void (*larger_border)(const BrickAround& a, const BrickAround& b, std::int16_t* samples) noexcept;
    /// Writes a vertex for each slot in `places`: the zero of the field on the grid's edge from that sample along
    /// `axis`, by linear interpolation. The normal is the unit gradient there, from central differences at both ends of
    /// the edge. May read seven slots after the last, and write seven vertices and eight bytes after the last. Pre: one
    /// end negative, the other not.
    void (*crossings)(const std::int16_t* samples, const std::uint16_t* places, std::size_t count, int axis,
                      const SampleFrame& frame, SurfaceVertex* vertices) noexcept;
};

/// The type of the functions that implement a stage: `KernelStage<&BlockKernel::depths> depths;` declares one.
template <auto stage>
using KernelStage = std::remove_pointer_t<std::remove_reference_t<decltype(std::declval<BlockKernel&>().*stage)>>;

/// Returns the kernel for any machine.
[[nodiscard]] const BlockKernel& portable_kernel() noexcept;
/// Returns the AVX2 kernel; null if the machine or the compiler has no AVX2.
[[nodiscard]] const BlockKernel* avx2_kernel() noexcept;

/// Returns the kernel that queries and stamps use: the fastest for this machine.   [any] nonblocking.
[[nodiscard]] const BlockKernel& block_kernel() noexcept;
/// Sets the kernel of the whole process, for tests and benchmarks that compare two kernels.   [main]
void use_block_kernel(const BlockKernel& kernel) noexcept;

}  // namespace kerf
