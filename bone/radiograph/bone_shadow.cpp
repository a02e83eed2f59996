// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/bone_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace kerf::bone {
namespace {

using Triple = std::array<double, 3>;
using Span = AttenuationImage::Span;

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
Triple triple(Vec3 v) noexcept { return {v.x, v.y, v.z}; }

/// The voxels that are not soft tissue; the last one is included.
struct Bounds {
    std::array<int, 3> low{}, high{};
};

std::optional<Bounds> bounds_of(const AttenuationImage& image) {
    const auto [nx, ny, nz] = image.voxels();
    Bounds all{{nx, ny, nz}, {-1, -1, -1}};
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j) {
            const Span line = image.bone_in_line(j, k);
            if (line.end <= line.begin) continue;
            all.low = {std::min<int>(all.low[0], line.begin), std::min(all.low[1], j), std::min(all.low[2], k)};
            all.high = {std::max<int>(all.high[0], line.end - 1), std::max(all.high[1], j), std::max(all.high[2], k)};
        }
    if (all.high[0] < 0) return std::nullopt;
    return all;
}

/// The rows of the slices across one axis, contiguous in memory. Slices across x are copied, some at a time.
class Slices {
public:
    Slices(const AttenuationImage& image, const Bounds& bounds, std::size_t axis)
        : image_(image), bounds_(bounds), axis_(axis) {
        if (axis != 0) return;
        const std::size_t rows = batch * index(image.voxels()[2]);
        values_.resize(rows * index(image.voxels()[1]));
        spans_.resize(rows);
    }
    /// Prepares slice `k`. Pre: slices come in ascending order.
    void go_to(int k) {
        slice_ = k;
        if (axis_ == 0 && (copied_ < 0 || k >= copied_ + static_cast<int>(batch))) copy(k);
    }
    /// Returns the values of row `r` of the slice, and the part of it that is bone.
    [[nodiscard]] std::pair<const std::uint8_t*, Span> row(int r) const noexcept {
        const auto [nx, ny, nz] = image_.voxels();
        const std::uint8_t* values = image_.values().data();
        if (axis_ == 2)
            return {values + (index(slice_) * index(ny) + index(r)) * index(nx), image_.bone_in_line(r, slice_)};
        if (axis_ == 1)
            return {values + (index(r) * index(ny) + index(slice_)) * index(nx), image_.bone_in_line(slice_, r)};
        const std::size_t at = index(slice_ - copied_) * index(nz) + index(r);
        return {values_.data() + at * index(ny), spans_[at]};
    }

private:
    static constexpr std::size_t batch = 16;

    void copy(int first) {
        const auto [nx, ny, nz] = image_.voxels();
        copied_ = first;
        std::fill(values_.begin(), values_.end(), AttenuationImage::water_value);
        std::fill(spans_.begin(), spans_.end(), Span{});
        for (int z = bounds_.low[2]; z <= bounds_.high[2]; ++z)
            for (int y = bounds_.low[1]; y <= bounds_.high[1]; ++y) {
                const Span line = image_.bone_in_line(y, z);
                const int begin = std::max<int>(line.begin, first);
                const int end = std::min<int>(line.end, first + static_cast<int>(batch));
                if (begin >= end) continue;
                const std::uint8_t* from = image_.values().data() + (index(z) * index(ny) + index(y)) * index(nx);
                for (int x = begin; x < end; ++x) {
                    const std::size_t at = index(x - first) * index(nz) + index(z);
                    values_[at * index(ny) + index(y)] = from[x];
                    Span& span = spans_[at];
                    if (span.end == 0) span.begin = static_cast<std::int16_t>(y);
                    span.end = static_cast<std::int16_t>(y + 1);
                }
            }
    }

    const AttenuationImage& image_;
    const Bounds& bounds_;
    std::size_t axis_;
    int slice_ = 0, copied_ = -1;
    std::vector<std::uint8_t> values_;
    std::vector<Span> spans_;
};

/// A beam in voxels of an image.
struct VoxelBeam {
    Triple source{}, first{}, column{}, row{};  ///< `first`: from the source to pixel (0, 0); then steps of a pixel

    VoxelBeam(const AttenuationImage& image, const Beam& beam) {
        const double to_voxels = 1.0 / image.spacing();
        source = triple(to_voxels * (beam.source - image.origin()));
        first = triple(to_voxels * (beam.pixel_centre(0, 0) - beam.source));
        column = triple((to_voxels * beam.pixel()) * beam.right);
        row = triple((-to_voxels * beam.pixel()) * beam.up);
    }
    /// Returns the vector from the source to a pixel.
    [[nodiscard]] Triple to(double c, double r) const noexcept {
        Triple d{};
        for (std::size_t a = 0; a < 3; ++a) d[a] = first[a] + c * column[a] + r * row[a];
        return d;
    }
};

/// Where slices are added up: the plane w = `plane`, sampled at equal steps along u and v. All in voxels.
struct Between {
    std::size_t u = 0, v = 1, w = 2;  ///< axes
    double plane = 0.0;
    double from_u = 0.0, from_v = 0.0, step = 1.0;
    int columns = 0, rows = 0;
    std::vector<float> sums{};
};

/// Returns the axis across which slices lie, or why there is none.
std::pair<std::size_t, std::string> slicing_axis(const Bounds& bounds, const VoxelBeam& beam, const Beam& made_of) {
    constexpr double smallest_cosine = 0.26;  // of 75°
    const std::array<Triple, 4> pixels{beam.to(0, 0), beam.to(made_of.columns - 1, 0), beam.to(0, made_of.rows - 1),
                                       beam.to(made_of.columns - 1, made_of.rows - 1)};
    std::size_t best = 3;
    double best_cosine = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // All rays must pass the slices in the same direction.
        const bool is_ahead = bounds.low[axis] > beam.source[axis] + 0.5,
                   is_behind = bounds.high[axis] < beam.source[axis] - 0.5;
        if (!is_ahead && !is_behind) continue;
        double cosine = 1.0;
        for (const Triple& d : pixels) {
            const double along = is_ahead ? d[axis] : -d[axis];
            cosine = std::min(cosine, along / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
        }
        if (cosine > best_cosine) best = axis, best_cosine = cosine;
    }
    if (best == 3) return {0, "The source lies in the bone, or the bone is not between it and the detector."};
    if (best_cosine < smallest_cosine) return {0, "The source is too near to the bone: rays are too oblique."};
    return {best, {}};
}

/// Returns whether all bone lies in front of the detector.
bool is_in_front(const Bounds& bounds, const VoxelBeam& beam) {
    const Triple normal{beam.column[1] * beam.row[2] - beam.column[2] * beam.row[1],
                        beam.column[2] * beam.row[0] - beam.column[0] * beam.row[2],
                        beam.column[0] * beam.row[1] - beam.column[1] * beam.row[0]};
    const auto along = [&](const Triple& d) { return d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2]; };
    const double detector = along(beam.first);
    for (int corner = 0; corner < 8; ++corner) {
        Triple d{};
        for (std::size_t a = 0; a < 3; ++a)
            d[a] = ((corner >> a & 1) != 0 ? bounds.high[a] : bounds.low[a]) - beam.source[a];
        if (along(d) / detector > 1.0) return false;
    }
    return true;
}

/// Returns the plane between the slices, and the part of it that both bone and detector use.
Between make_between(const Bounds& bounds, const VoxelBeam& beam, const Beam& made_of, std::size_t axis) {
    Between b;
    b.w = axis;
    b.u = axis == 0 ? 1 : 0;
    b.v = axis == 2 ? 1 : 2;
    b.plane = 0.5 * (bounds.low[axis] + bounds.high[axis]);
    const double height = b.plane - beam.source[axis];

    std::array<double, 4> bone{1e30, -1e30, 1e30, -1e30}, seen = bone;  // u low, u high, v low, v high
    const auto join = [](std::array<double, 4>& range, double u, double v) {
        range = {std::min(range[0], u), std::max(range[1], u), std::min(range[2], v), std::max(range[3], v)};
    };
    for (int corner = 0; corner < 8; ++corner) {
        Triple at{};
        for (std::size_t a = 0; a < 3; ++a) at[a] = (corner >> a & 1) != 0 ? bounds.high[a] + 1.0 : bounds.low[a] - 1.0;
        const double f = height / (at[axis] - beam.source[axis]);
        join(bone, beam.source[b.u] + f * (at[b.u] - beam.source[b.u]),
             beam.source[b.v] + f * (at[b.v] - beam.source[b.v]));
    }
    const auto on_plane = [&](double c, double r) {
        const Triple d = beam.to(c, r);
        const double t = height / d[axis];
        return std::array{beam.source[b.u] + t * d[b.u], beam.source[b.v] + t * d[b.v]};
    };
    for (const double c : {-1.0, made_of.columns + 0.0})
        for (const double r : {-1.0, made_of.rows + 0.0}) {
            const auto [u, v] = on_plane(c, r);
            join(seen, u, v);
        }
    const double u_low = std::max(bone[0], seen[0]), u_high = std::min(bone[1], seen[1]);
    const double v_low = std::max(bone[2], seen[2]), v_high = std::min(bone[3], seen[3]);
    if (!(u_low < u_high && v_low < v_high)) return b;  // the beam passes the bone

    const double middle_c = 0.5 * made_of.columns, middle_r = 0.5 * made_of.rows;
    const auto middle = on_plane(middle_c, middle_r), beside = on_plane(middle_c + 1, middle_r),
               below = on_plane(middle_c, middle_r + 1);
    const double pixel = std::min(std::hypot(beside[0] - middle[0], beside[1] - middle[1]),
                                  std::hypot(below[0] - middle[0], below[1] - middle[1]));
    // Finer than pixels, so that edges along the beam stay sharp.
    constexpr double finest = 0.35, coarsest = 0.7, max_steps = 1023.0;  // [voxels], [voxels], steps
    b.step = std::max(
        {std::clamp(0.6 * pixel, finest, coarsest), (u_high - u_low) / max_steps, (v_high - v_low) / max_steps});
    b.from_u = u_low;
    b.from_v = v_low;
    b.columns = static_cast<int>((u_high - u_low) / b.step) + 2;
    b.rows = static_cast<int>((v_high - v_low) / b.step) + 2;
    b.sums.assign(index(b.columns) * index(b.rows), 0.0f);
    return b;
}

/// One row of a slice at the columns of the plane between, as seen from the source.
class ScaledRow {
public:
    explicit ScaledRow(int columns) : values_(index(columns), 0.0f) {}
    [[nodiscard]] const float* values() const noexcept { return values_.data(); }
    [[nodiscard]] int begin() const noexcept { return begin_; }
    [[nodiscard]] int end() const noexcept { return end_; }

    void clear() noexcept {
        std::fill(values_.begin() + begin_, values_.begin() + end_, 0.0f);
        begin_ = end_ = 0;
    }
    /// Columns [begin, end) take the values between `at[i]` and `at[i] + 1` of a row, whose values are in `row`.
    void take(const float* row, const std::int32_t* at, const float* fraction, int begin, int end) noexcept {
        clear();
        begin_ = begin;
        end_ = end;
        float* out = values_.data();
        for (int i = begin; i < end; ++i) {
            const float* v = row + at[i];
            out[i] = v[0] + fraction[i] * (v[1] - v[0]);
        }
    }

private:
    std::vector<float> values_;
    int begin_ = 0, end_ = 0;
};

/// Adds the slices to the plane between them: Σ over the slices of (value − water).
void add_slices(const AttenuationImage& image, const Bounds& bounds, const VoxelBeam& beam, Between& between) {
    if (between.sums.empty()) return;
    Slices slices(image, bounds, between.w);
    const double source_u = beam.source[between.u], source_v = beam.source[between.v],
                 source_w = beam.source[between.w];
    const int row_length = image.voxels()[between.u];
    std::vector<std::int32_t> at(index(between.columns));
    std::vector<float> fraction(index(between.columns));
    std::vector<float> row(index(row_length) + 3, 0.0f);  // a 0 before and two behind
    ScaledRow near(between.columns), far(between.columns);

    for (int k = bounds.low[between.w]; k <= bounds.high[between.w]; ++k) {
        slices.go_to(k);
        const double f = (k - source_w) / (between.plane - source_w), step = f * between.step;
        const double first_u = source_u + f * (between.from_u - source_u);
        const double first_v = source_v + f * (between.from_v - source_v);
        for (int i = 0; i < between.columns; ++i) {
            const double u = first_u + i * step + 1.0, cell = std::max(std::floor(u), 0.0);
            at[index(i)] = static_cast<std::int32_t>(cell);
            fraction[index(i)] = static_cast<float>(u - cell);
        }
        const auto scale = [&](int r, ScaledRow& out) {
            out.clear();
            if (r < bounds.low[between.v] || r > bounds.high[between.v]) return;
            const auto [values, span] = slices.row(r);
            if (span.end <= span.begin) return;
            const int begin = std::max(0, static_cast<int>(std::ceil((span.begin - 1 - first_u) / step)));
            const int end = std::min(between.columns, static_cast<int>(std::floor((span.end - first_u) / step)) + 1);
            if (begin >= end) return;
            row[index(span.begin)] = row[index(span.end) + 1] = row[index(span.end) + 2] = 0.0f;
            if (span.begin > 0) row[index(span.begin) - 1] = 0.0f;
            for (int i = span.begin; i < span.end; ++i)
                row[index(i) + 1] = static_cast<float>(values[i] - AttenuationImage::water_value);
            out.take(row.data(), at.data(), fraction.data(), begin, end);
        };

        int scaled = -10;  // row that `near` has; `far` has the next one
        for (int j = 0; j < between.rows; ++j) {
            const double v = first_v + j * step, cell = std::floor(v);
            const int r = static_cast<int>(cell);
            if (r < bounds.low[between.v] - 1 || r > bounds.high[between.v]) continue;
            if (r == scaled + 1) {
                std::swap(near, far);
                scale(r + 1, far);
            } else if (r != scaled) {
                scale(r, near);
                scale(r + 1, far);
            }
            scaled = r;
            const float upper = static_cast<float>(v - cell), lower = 1.0f - upper;
            float* sums = between.sums.data() + index(j) * index(between.columns);
            const bool has_near = near.begin() < near.end(), has_far = far.begin() < far.end();
            if (!has_near && !has_far) continue;
            const int begin = !has_near ? far.begin() : !has_far ? near.begin() : std::min(near.begin(), far.begin());
            const int end = std::max(near.end(), far.end());
            const float *a = near.values(), *b = far.values();
            for (int i = begin; i < end; ++i) sums[i] += lower * a[i] + upper * b[i];
        }
    }
}

/// Returns the length of a ray in an ellipsoid, as a fraction of the ray from source to detector [–].
double fraction_inside(const Triple& from_centre, const Triple& ray, const Triple& inverse_axes) noexcept {
    double a = 0.0, b = 0.0, c = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double o = from_centre[i] * inverse_axes[i], d = ray[i] * inverse_axes[i];
        a += d * d;
        b += o * d;
        c += o * o;
    }
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0.0)) return 0.0;
    const double root = std::sqrt(discriminant);
    return std::max(0.0, std::min((root - b) / a, 1.0) - std::max((-root - b) / a, 0.0));
}

/// Projects the plane between the slices on the detector.
void warp(const AttenuationImage& image, const VoxelBeam& beam, const Between& between, BoneShadow& shadow) {
    const double h = image.spacing();
    const double per_step = AttenuationImage::step * h, per_voxel = water_attenuation * h;
    const Vec3 axes = image.soft_tissue().semi_axes;
    const Triple inverse_axes{h / axes.x, h / axes.y, h / axes.z};
    const Triple tissue = triple((1.0 / h) * (image.soft_tissue().centre - image.origin()));
    Triple from_centre{};
    for (std::size_t a = 0; a < 3; ++a) from_centre[a] = beam.source[a] - tissue[a];
    const double height = between.plane - beam.source[between.w], inverse_step = 1.0 / between.step;
    for (int r = 0; r < shadow.rows; ++r)
        for (int c = 0; c < shadow.columns; ++c) {
            const std::size_t pixel = index(r) * index(shadow.columns) + index(c);
            const Triple d = beam.to(c, r);
            const double ray = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            shadow.soft[pixel] = static_cast<float>(per_voxel * ray * fraction_inside(from_centre, d, inverse_axes));
            if (between.sums.empty()) continue;
            const double t = height / d[between.w];
            const double x = (beam.source[between.u] + t * d[between.u] - between.from_u) * inverse_step;
            const double y = (beam.source[between.v] + t * d[between.v] - between.from_v) * inverse_step;
            if (!(x >= 0.0 && y >= 0.0 && x < between.columns - 1 && y < between.rows - 1)) continue;
            const int i = static_cast<int>(x), j = static_cast<int>(y);
            const float fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
            const float* s = between.sums.data() + index(j) * index(between.columns) + index(i);
            const float *above = s, *below = s + between.columns;
            const float top = above[0] + fx * (above[1] - above[0]), bottom = below[0] + fx * (below[1] - below[0]);
            const double sum = static_cast<double>(top + fy * (bottom - top));
            shadow.bone[pixel] = static_cast<float>(sum * per_step * ray / std::abs(d[between.w]));
        }
}

}  // namespace

BoneShadow bone_shadow(const AttenuationImage& image, const Beam& beam) {
    BoneShadow shadow;
    shadow.error = error_of(beam);
    if (!shadow.error.empty()) return shadow;
    if (image.values().empty()) {
        shadow.error = "There is no bone to take a picture of.";
        return shadow;
    }
    const VoxelBeam in_voxels(image, beam);
    const std::optional<Bounds> bounds = bounds_of(image);
    Between between;
    if (bounds) {
        const auto [axis, error] = slicing_axis(*bounds, in_voxels, beam);
        shadow.error = error;
        if (error.empty() && !is_in_front(*bounds, in_voxels)) shadow.error = "The detector lies in the bone.";
        if (!shadow.error.empty()) return shadow;
        between = make_between(*bounds, in_voxels, beam, axis);
        add_slices(image, *bounds, in_voxels, between);
    }
    shadow.columns = beam.columns;
    shadow.rows = beam.rows;
    shadow.bone.assign(index(beam.columns) * index(beam.rows), 0.0f);
    shadow.soft = shadow.bone;
    warp(image, in_voxels, between, shadow);
    return shadow;
}

}  // namespace kerf::bone
