// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/field/grid/density_field.h"
#include "core/field/grid/level_set.h"
#include "core/field/grid/region.h"

/// A bone: its surface, and its materials in the order of priority. Immutable after import.
namespace kerf {

struct Material {
    std::string id;
    double density = 0.0;         ///< [kg/m³]; of a heterogeneous material the maximum, used to check limits
    LevelSet border;              ///< negative inside this material; unused for the last (base) material
    DensityField densities = {};  ///< of a heterogeneous material; if empty, `density` everywhere
};

/// Frame: LPS, metres. The last material is the base: it fills the volume that the other materials leave.
struct Body {
    std::string id;
    LevelSet surface;  ///< negative inside bone, before any cut
    /// Cavities in the bone, negative inside them; empty: none. Surface and cavities are separate fields that are
    /// combined after interpolation. So they represent a sheet of bone between them, however thin. Every cut field
    /// begins with the cavities as removed bone.
    LevelSet hollow = {};
    std::vector<Material> materials;  ///< 1 … KERF_MAX_TISSUES
    Region region = {};               ///< its faces lie on samples; unbounded: the grid contains all bone

    [[nodiscard]] const Grid& grid() const noexcept { return surface.grid(); }
};

/// Returns the distance of a point (body frame) to the body's region [m]; 0 inside, without bounds, or for NaN.
/// Outside, bone cannot be cut, so the haptic loop stops the tool there.   [any] pure, nonblocking.
[[nodiscard]] inline double outside_region(const Body& body, Vec3 point_in_body) noexcept {
    return body.region.distance_outside(point_in_body);
}

/// Returns the cell in which to sample bone at a point (body frame). For a point outside the region, it is the cell of
/// the nearest point of the region.   [any] pure, nonblocking.
[[nodiscard]] inline LocatedPoint locate(const Body& body, Vec3 point_in_body) noexcept {
    return locate(body.grid(), body.region.nearest(point_in_body));
}

inline constexpr float quantum_in_voxels = static_cast<float>(clamp_voxels / 32767.0);

/// Returns the fraction inside a level set at the signed distance `d` [quanta]: 1 inside, ½ on the border, 0 outside.
/// It is linear over `ramp` voxels.
[[nodiscard]] inline float coverage(float d, float ramp = 0.25f) noexcept {
    return std::min(std::max(0.5f - d * (quantum_in_voxels / ramp), 0.0f), 1.0f);
}

/// Returns the signed distance to the bone before any cut [m], negative inside, with cavities as outside.
/// [any] pure, nonblocking.
[[nodiscard]] inline double uncut_distance(const Body& body, const LocatedPoint& place) noexcept {
    const double distance = body.surface.at(place);
    return body.hollow.is_empty() ? distance : std::max(distance, -body.hollow.at(place));
}

/// Returns the fraction of an edge that is in bone [–]. `uncut` [quanta] is the signed distance to the bone before any
/// cut, `cut` [quanta] the cut at the point (negative where bone remains). The border of the cut is accurate to 1/20
/// voxel, so its ramp extends only that far to either side. The end of a lip moves along the wall of its own hole, and
/// must get no force there.
[[nodiscard]] inline float engagement(float uncut, float cut) noexcept {
    const float there = coverage(uncut), left = coverage(cut, 0.1f);
    return std::min(left, there);
}

/// Writes the weights [–] of the materials at a point, in the order of priority; they sum to 1. Pre: the point is in
/// the grid.
inline void material_weights(const Body& body, const LocatedPoint& place, double (&weight)[KERF_MAX_TISSUES]) noexcept {
    float left = 1.0f;
    const std::size_t last = body.materials.size() - 1;
    for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) weight[m] = 0.0;
    for (std::size_t m = 0; m < last; ++m) {
        const float fraction = left * coverage(body.materials[m].border.quanta_at(place));
        weight[m] = static_cast<double>(fraction);
        left -= fraction;
    }
    weight[last] = static_cast<double>(left);
}

/// Writes the weights [–] of the materials for a block of points: `weight[m][i]` of material m at point i.
inline void material_weights(const Body& body, const LocatedBlock& places,
                             std::array<FloatBlock, KERF_MAX_TISSUES>& weight) noexcept {
    const std::size_t last = body.materials.size() - 1;
    FloatBlock& left = weight[last];
    std::fill_n(left.begin(), places.count, 1.0f);
    FloatBlock border;
    for (std::size_t m = 0; m < last; ++m) {
        body.materials[m].border.quanta_at(places, border);
        for (std::size_t i = 0; i < places.count; ++i) {
            weight[m][i] = left[i] * coverage(border[i]);
            left[i] -= weight[m][i];
        }
    }
}

}  // namespace kerf
