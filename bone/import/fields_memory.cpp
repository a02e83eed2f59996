// SPDX-License-Identifier: Apache-2.0
#include "bone/import/fields_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/field/grid/grid.h"

namespace kerf::bone {
namespace {

constexpr int probes = 20'000;
constexpr double margin_voxels = 6.0;  // of air around the bone
constexpr double max_bricks = 16e6;    // in a grid: 64 MB of tables per field

}  // namespace

FieldsMemory fields_memory(const Box& bounds, double spacing, const std::vector<std::function<double(Vec3)>>& borders,
                           bool has_densities) {
    const double margin = margin_voxels * spacing;
    const Vec3 low = bounds.low - margin * Vec3{1, 1, 1},
               extent = bounds.high - bounds.low + 2.0 * margin * Vec3{1, 1, 1};
    const double edge = brick_edge * spacing;
    FieldsMemory needed;
    needed.bricks = extent.x / edge * (extent.y / edge) * (extent.z / edge);

    // Quasi-random points without a seed: multiples of the plastic number's powers, modulo 1.
    constexpr double g = 1.22074408460575947536;
    const double reach = (0.5 * brick_edge * std::sqrt(3.0) + clamp_voxels) * spacing;
    const auto part_of = [](double value) { return value - std::floor(value); };
    double near = 0.0, inside = 0.0;  // probes near a border, summed over the fields; probes not in air
    for (int i = 1; i <= probes; ++i) {
        const Vec3 at{part_of(i / g), part_of(i / (g * g)), part_of(i / (g * g * g))};
        const Vec3 p = low + Vec3{at.x * extent.x, at.y * extent.y, at.z * extent.z};
        for (std::size_t n = 0; n < borders.size(); ++n) {
            const double distance = borders[n](p);
            near += std::abs(distance) <= reach;
            if (n == 0) inside += distance <= reach;
        }
    }
    needed.cuttable = needed.bricks * inside / probes;
    const double samples = near * sizeof(std::int16_t) + (has_densities ? inside * sizeof(float) : 0.0);
    needed.bytes = needed.bricks *
                   (static_cast<double>(borders.size()) * sizeof(std::int32_t) + samples / probes * stored_samples);
    return needed;
}

double excess_of(const FieldsMemory& needed) noexcept {
    return std::max({needed.bytes / max_bone_memory, needed.bricks / max_bricks,
                     needed.cuttable / (0.97 * max_stored_bricks /* probes are a few per cent off */)});
}

}  // namespace kerf::bone
