// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/metal_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::bone {
namespace {

constexpr double nearest = 0.02;            // of the distance from the source to the detector
constexpr int subpixel_bits = 8;            // of corners: neighbours use the same edges, so no pixel is missed
constexpr double farthest_pixel = 1 << 20;  // a corner beyond would overflow
constexpr std::int64_t one = 1 << subpixel_bits;

/// A corner from the source: along the detector's axes [pixels at the detector, times depth], and depth along its
/// normal, 1 at the detector.
struct Corner {
    double x = 0.0, y = 0.0, depth = 0.0;
};

struct FixedCorner {
    std::int64_t x = 0, y = 0;
};

std::int64_t floor_divided(std::int64_t a, std::int64_t b) noexcept {  // b > 0
    const std::int64_t q = a / b;
    return a % b < 0 ? q - 1 : q;
}

/// Adds triangles to a picture.
class Projector {
public:
    Projector(const Beam& beam, std::vector<float>& sums) : beam_(beam), sums_(sums) {
        const Vec3 to_centre = beam.centre - beam.source;
        normal_ = cross(beam.right, beam.up);
        const double distance = dot(to_centre, normal_);
        normal_ = (1.0 / distance) * normal_;
        centre_x_ = 0.5 * beam.columns - dot(to_centre, beam.right) / beam.pixel();
        centre_y_ = 0.5 * beam.rows + dot(to_centre, beam.up) / beam.pixel();
        // Seen from the source, the picture is mirrored if right × up points away from it.
        front_ = distance < 0.0 ? 1.0 : -1.0;
    }

    [[nodiscard]] Corner corner(Vec3 world) const noexcept {
        const Vec3 d = world - beam_.source;
        const double depth = dot(d, normal_);
        return {dot(d, beam_.right) / beam_.pixel() + centre_x_ * depth,
                centre_y_ * depth - dot(d, beam_.up) / beam_.pixel(), depth};
    }

    /// Adds a triangle, without its part that is nearer than `nearest`.
    void add(const std::array<Corner, 3>& triangle, double attenuation) {
        std::array<Corner, 4> part;
        std::size_t count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner &a = triangle[i], &b = triangle[(i + 1) % 3];
            if (a.depth >= nearest) part[count++] = a;
            if ((a.depth >= nearest) != (b.depth >= nearest)) {
                // From the nearer end, so that both triangles of an edge get the same point.
                const Corner &low = a.depth < b.depth ? a : b, &high = a.depth < b.depth ? b : a;
                const double t = (nearest - low.depth) / (high.depth - low.depth);
                part[count++] = {low.x + t * (high.x - low.x), low.y + t * (high.y - low.y), nearest};
            }
        }
        for (std::size_t i = 2; i < count; ++i) fill({part[0], part[i - 1], part[i]}, attenuation);
    }

private:
    void fill(const std::array<Corner, 3>& triangle, double attenuation) {
        std::array<FixedCorner, 3> p;
        double lowest = triangle[0].depth, highest = lowest;
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = triangle[i].x / triangle[i].depth, y = triangle[i].y / triangle[i].depth;
            if (!(std::abs(x) < farthest_pixel && std::abs(y) < farthest_pixel)) return;
            p[i] = {static_cast<std::int64_t>(std::floor(x * one + 0.5)),
                    static_cast<std::int64_t>(std::floor(y * one + 0.5))};
            lowest = std::min(lowest, triangle[i].depth);
            highest = std::max(highest, triangle[i].depth);
        }
        std::int64_t area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
        if (area == 0) return;
        // Rows run downwards: a face towards the source has a negative area.
        const double sign = front_ * (area < 0 ? -1.0 : 1.0) * attenuation;
        if (area < 0) std::swap(p[1], p[2]);

        // 1 / depth is linear in the picture.
        const auto [a, b, c] = inverse_depth(triangle);
        lowest = std::min(lowest, 1.0);
        highest = std::min(highest, 1.0);
        const auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
        const int first = static_cast<int>(std::max<std::int64_t>(0, floor_divided(low_y - one / 2, one)));
        const int last = static_cast<int>(std::min<std::int64_t>(beam_.rows - 1, floor_divided(high_y, one)));
        for (int row = first; row <= last; ++row) {
            std::int64_t begin = 0, end = beam_.columns;
            for (std::size_t i = 0; i < 3; ++i) limit(p[i], p[(i + 1) % 3], row, begin, end);
            float* sums = sums_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(beam_.columns);
            for (std::int64_t column = begin; column < end; ++column) {
                const double inverse = a * (static_cast<double>(column) + 0.5) + b * (row + 0.5) + c;
                const double depth = inverse > 0.0 ? std::clamp(1.0 / inverse, lowest, highest) : highest;
                sums[column] += static_cast<float>(sign * (depth - nearest));
            }
        }
    }

    /// Returns 1 / depth = a x + b y + c in the plane of a triangle.
    [[nodiscard]] static std::array<double, 3> inverse_depth(const std::array<Corner, 3>& t) noexcept {
        // In homogeneous corners (x, y, depth), the plane n · corner = n · corner 0 is 1 / depth = n · (x, y, 1) /
        // that.
        const Vec3 p0{t[0].x, t[0].y, t[0].depth}, p1{t[1].x, t[1].y, t[1].depth}, p2{t[2].x, t[2].y, t[2].depth};
        const Vec3 n = cross(p1 - p0, p2 - p0);
        const double d = dot(n, p0);
        return d == 0.0 ? std::array{0.0, 0.0, 1.0 / t[0].depth} : std::array{n.x / d, n.y / d, n.z / d};
    }

    /// Limits the columns of a row to those whose middle lies inside an edge, on the edge by the top-left rule.
    static void limit(FixedCorner from, FixedCorner to, int row, std::int64_t& begin, std::int64_t& end) noexcept {
        const std::int64_t dx = to.x - from.x, dy = to.y - from.y;
        // Inside: dx (Y − from.y) − dy (X − from.x) ≥ 0, with X = one (column + ½).
        const bool owns_border = dy < 0 || (dy == 0 && dx > 0);
        const std::int64_t y = row * one + one / 2,
                           rest = dx * (y - from.y) + dy * from.x - dy * (one / 2) - (owns_border ? 0 : 1);
        if (dy == 0) {
            if (rest < 0) end = begin;
        } else if (dy < 0) {
            begin = std::max(begin, -floor_divided(rest, -dy * one));
        } else {
            end = std::min(end, floor_divided(rest, dy * one) + 1);
        }
    }

    const Beam& beam_;
    std::vector<float>& sums_;
    Vec3 normal_{};
    double centre_x_ = 0.0, centre_y_ = 0.0, front_ = 1.0;
};

}  // namespace

std::vector<float> metal_shadow(std::span<const MetalShape> shapes, const Beam& beam) {
    if (!error_of(beam).empty()) return {};
    std::vector<float> sums(static_cast<std::size_t>(beam.columns) * static_cast<std::size_t>(beam.rows), 0.0f);
    Projector projector(beam, sums);
    std::vector<Corner> corners;
    for (const MetalShape& shape : shapes) {
        if (!is_finite(shape.world_from_shape) || !std::isfinite(shape.attenuation)) continue;
        corners.clear();
        for (const auto& p : shape.positions)
            corners.push_back(projector.corner(shape.world_from_shape * Vec3{p[0], p[1], p[2]}));
        for (const auto& t : shape.triangles) {
            if (std::max({t[0], t[1], t[2]}) >= corners.size()) continue;
            const std::array triangle{corners[t[0]], corners[t[1]], corners[t[2]]};
            const bool is_sound = std::all_of(triangle.begin(), triangle.end(), [](const Corner& c) {
                return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.depth);
            });
            if (is_sound) projector.add(triangle, shape.attenuation);
        }
    }
    for (int r = 0; r < beam.rows; ++r)
        for (int c = 0; c < beam.columns; ++c) {
            float& sum = sums[static_cast<std::size_t>(r) * static_cast<std::size_t>(beam.columns) +
                              static_cast<std::size_t>(c)];
            if (sum != 0.0f)
                sum = std::max(0.0f, sum * static_cast<float>(length(beam.pixel_centre(c, r) - beam.source)));
        }
    return sums;
}

}  // namespace kerf::bone
