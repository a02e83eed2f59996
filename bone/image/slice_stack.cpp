// SPDX-License-Identifier: Apache-2.0
#include "bone/image/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace kerf::bone {
namespace {

constexpr double wide = 1.25;        // times the usual distance: wider means a missing slice
constexpr double same_plane = 1e-3;  // times the usual distance, and at least a micrometre
constexpr double max_voxels = 512.0 * 1024 * 1024;
constexpr float unmeasured = std::numeric_limits<float>::quiet_NaN();

/// Offset of a slice's first voxel in the plane, from that of the first slice [voxels].
struct Offset {
    double columns = 0.0, rows = 0.0;
};

Offset offset_of(const SliceStack& stack, std::size_t slice) {
    const Vec3 from_first = stack.origins[slice] - stack.origins[0];
    return {dot(from_first, stack.along_row) / dot(stack.along_row, stack.along_row),
            dot(from_first, stack.down_column) / dot(stack.down_column, stack.down_column)};
}

/// Returns the median; of an even number the lower one, so that one gap among two steps counts as a gap.
double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// One slice, moved to its position in the grid's plane by whole voxels and a fraction.
class PlacedSlice {
public:
    PlacedSlice(const SliceStack& stack, std::size_t slice, Vec3 grid_origin, std::vector<float> values)
        : columns_(stack.columns), rows_(stack.rows), values_(std::move(values)) {
        const Vec3 shift = grid_origin - stack.origins[slice];
        const auto split = [](double at, int& whole, float& fraction) {
            const double nearest = std::round(at);
            if (std::abs(at - nearest) < 1e-4) at = nearest;  // rounding of positions causes no smoothing
            whole = static_cast<int>(std::floor(at));
            fraction = static_cast<float>(at - std::floor(at));
        };
        split(dot(shift, stack.along_row) / dot(stack.along_row, stack.along_row), column_, column_fraction_);
        split(dot(shift, stack.down_column) / dot(stack.down_column, stack.down_column), row_, row_fraction_);
    }

    /// Returns the value at a voxel (i, j) of the grid's plane.
    [[nodiscard]] float at(int i, int j) const noexcept {
        const int c = i + column_, r = j + row_;
        const auto between = [](float a, float b, float fraction) {
            return fraction > 0.0f ? a + fraction * (b - a) : a;
        };
        const float upper = between(voxel(c, r), column_fraction_ > 0.0f ? voxel(c + 1, r) : 0.0f, column_fraction_);
        if (!(row_fraction_ > 0.0f)) return upper;
        return between(upper,
                       between(voxel(c, r + 1), column_fraction_ > 0.0f ? voxel(c + 1, r + 1) : 0.0f, column_fraction_),
                       row_fraction_);
    }

private:
    [[nodiscard]] float voxel(int c, int r) const noexcept {
        if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return unmeasured;
        return values_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)];
    }

    int columns_, rows_;
    std::vector<float> values_;
    int column_ = 0, row_ = 0;
    float column_fraction_ = 0.0f, row_fraction_ = 0.0f;
};

/// The two slices around a height, and the fraction of the distance from the lower to the upper one.
struct Between {
    std::size_t lower = 0, upper = 0;
    float fraction = 0.0f;
};

Between around(const std::vector<double>& heights, double height) {
    const auto above = std::upper_bound(heights.begin(), heights.end(), height);
    if (above == heights.begin()) return {};
    const std::size_t lower = static_cast<std::size_t>(above - heights.begin()) - 1;
    if (lower + 1 == heights.size()) return {lower, lower, 0.0f};
    const double fraction = (height - heights[lower]) / (heights[lower + 1] - heights[lower]);
    if (fraction < 1e-3) return {lower, lower, 0.0f};
    if (fraction > 1.0 - 1e-3) return {lower + 1, lower + 1, 0.0f};
    return {lower, lower + 1, static_cast<float>(fraction)};
}

}  // namespace

StackShape shape_of(const SliceStack& stack) {
    StackShape shape;
    const std::size_t count = stack.origins.size();
    std::vector<double> heights, steps;
    for (std::size_t n = 0; n < count; ++n) heights.push_back(stack.height(n));
    for (std::size_t n = 1; n < count; ++n) steps.push_back(heights[n] - heights[n - 1]);
    shape.distance = median(steps);
    shape.min_distance = *std::min_element(steps.begin(), steps.end());
    shape.max_distance = *std::max_element(steps.begin(), steps.end());
    for (std::size_t n = 0; n < steps.size(); ++n) {
        if (steps[n] <= std::max(1e-6, same_plane * shape.distance)) ++shape.repeated;
        if (steps[n] > wide * shape.distance) shape.gaps.push_back({n, steps[n]});
    }

    // Deviation in height from even steps between first and last slice, and sideways from the best straight line.
    const double whole = heights.back();
    double of_heights = 0.0;
    Offset slope;
    for (std::size_t n = 0; n < count; ++n) {
        const double even = whole * static_cast<double>(n) / static_cast<double>(count - 1);
        shape.unevenness = std::max(shape.unevenness, std::abs(heights[n] - even));
        const Offset offset = offset_of(stack, n);
        of_heights += heights[n] * heights[n];
        slope.columns += heights[n] * offset.columns;
        slope.rows += heights[n] * offset.rows;
    }
    if (!(of_heights > 0.0)) return shape;
    slope.columns /= of_heights;
    slope.rows /= of_heights;
    for (std::size_t n = 0; n < count; ++n) {
        const Offset offset = offset_of(stack, n);
        shape.crookedness = std::max(shape.crookedness, std::hypot(offset.columns - slope.columns * heights[n],
                                                                   offset.rows - slope.rows * heights[n]));
    }
    shape.shift = std::hypot(slope.columns, slope.rows) * whole;
    shape.tilt = std::atan(length(slope.columns * stack.along_row + slope.rows * stack.down_column));
    return shape;
}

double straight_steps(const SliceStack& stack, const StackShape& shape) {
    const std::size_t last = stack.origins.size() - 1;
    if (shape.is_even()) return static_cast<double>(last);
    return std::max(1.0, std::ceil(stack.height(last) / shape.min_distance - 1e-3));
}

VoxelGrid straight_grid(const SliceStack& stack, const StackShape& shape) {
    Offset low, high;
    for (std::size_t n = 0; n < stack.origins.size(); ++n) {
        const Offset offset = offset_of(stack, n);
        low = {std::min(low.columns, offset.columns), std::min(low.rows, offset.rows)};
        high = {std::max(high.columns, offset.columns), std::max(high.rows, offset.rows)};
    }
    const double whole = stack.height(stack.origins.size() - 1);
    const double steps = straight_steps(stack, shape);
    if (shape.is_straight()) low = high = {};

    const double columns = stack.columns + std::ceil(high.columns - low.columns - 1e-3);
    const double rows = stack.rows + std::ceil(high.rows - low.rows - 1e-3);
    VoxelGrid grid;
    if (!(columns * rows * (steps + 1.0) <= max_voxels)) return grid;
    grid.size = {static_cast<int>(columns), static_cast<int>(rows), static_cast<int>(steps) + 1};
    grid.place(stack.along_row, stack.down_column, whole / steps * stack.normal(),
               stack.origins[0] + low.columns * stack.along_row + low.rows * stack.down_column);
    return grid;
}

VoxelImage straightened(const SliceStack& stack, const StackShape& shape, const VoxelGrid& grid,
                        const VoxelRange& range, const SliceReader& read) {
    VoxelImage image;
    static_cast<VoxelGrid&>(image) = grid.part(range);
    image.values.reserve(range.voxels());

    std::vector<double> heights;
    for (std::size_t n = 0; n < stack.origins.size(); ++n)
        heights.push_back(shape.is_straight() ? grid.spacing(2) * static_cast<double>(n) : stack.height(n));
    std::vector<std::pair<std::size_t, PlacedSlice>> open;  // two at most
    const auto slice = [&](std::size_t n) -> const PlacedSlice* {
        for (const auto& [number, placed] : open)
            if (number == n) return &placed;
        std::vector<float> values = read(n);
        if (values.empty()) return nullptr;
        if (open.size() == 2) open.erase(open.begin());
        const Vec3 in_plane = grid.origin();
        open.emplace_back(n, PlacedSlice(stack, shape.is_straight() ? 0 : n, in_plane, std::move(values)));
        return &open.back().second;
    };

    float lowest = std::numeric_limits<float>::infinity();
    for (int k = range.first[2]; k < range.first[2] + range.size[2]; ++k) {
        const Between between = around(heights, grid.spacing(2) * k);
        if (slice(between.lower) == nullptr || slice(between.upper) == nullptr) {
            image.values.clear();
            return image;
        }
        const PlacedSlice &lower = *slice(between.lower), &upper = *slice(between.upper);
        for (int j = range.first[1]; j < range.first[1] + range.size[1]; ++j)
            for (int i = range.first[0]; i < range.first[0] + range.size[0]; ++i) {
                float value = lower.at(i, j);
                if (between.fraction > 0.0f) value += between.fraction * (upper.at(i, j) - value);
                image.values.push_back(value);
                if (value < lowest) lowest = value;
            }
    }
    if (!std::isfinite(lowest)) lowest = 0.0f;
    for (float& value : image.values)
        if (std::isnan(value)) value = lowest;
    return image;
}

}  // namespace kerf::bone
