// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "core/field/grid/box.h"
#include "documents/anatomy.h"

/// Distances to the implicit solids that phantoms and zones are made of.
namespace kerf::documents {

/// Axes of a superellipsoid: unit vectors, and half of its size in their directions [m].
struct SuperellipsoidAxes {
    Vec3 side{}, up{}, along{};
    Vec3 half{};
};
/// [any] pure.
[[nodiscard]] SuperellipsoidAxes axes_of(const SuperellipsoidSolid& solid) noexcept;

/// Signed distance [m], negative inside; exact for box, tube and sphere, a lower bound outside an elliptic tube; of a
/// superellipsoid within 5 % and 0.02 mm; for a loft see documents/loft.h.   [any] pure.
/// A distance of more than `limit` [m] may be smaller, but not than `limit`.
[[nodiscard]] double distance_to(const Solid& solid, Vec3 point, double limit = HUGE_VAL) noexcept;

/// To the union of solids; +infinity for none.
[[nodiscard]] double distance_to_any(const std::vector<Solid>& solids, Vec3 point) noexcept;

/// Returns the thickness of a tissue's shell at a point [m]. It changes smoothly from a region to the rest.
/// [any] pure.
[[nodiscard]] double thickness_at(const Tissue& tissue, Vec3 point) noexcept;
/// Returns the density of a tissue at a point [kg/m³]. It changes smoothly from a region to the rest.   [any] pure.
[[nodiscard]] double density_at(const Tissue& tissue, Vec3 point) noexcept;

/// Returns the smallest and the largest thickness of a tissue's shell [m].
[[nodiscard]] double thinnest(const Tissue& tissue) noexcept;
[[nodiscard]] double thickest(const Tissue& tissue) noexcept;

/// To where a tissue is, which is no base [m]: its shell, its solids, or what both have in common.
/// @param depth  [m] of the place under the surface that shells lie under
[[nodiscard]] double distance_to(const Tissue& tissue, double depth, Vec3 point) noexcept;

/// To the union of two solids at these distances [m], with a fillet. Its radius is exact where their surfaces meet at a
/// right angle.   [any] pure.
[[nodiscard]] double united(double a, double b, double radius) noexcept;

/// To what there is so far [m], with a part added or taken away. `limit` is that of its solid's distance.   [any] pure.
[[nodiscard]] double joined_with(double so_far, const PhantomPart& part, Vec3 point, double limit = HUGE_VAL) noexcept;

/// To a phantom: parts united and subtracted in their order.
[[nodiscard]] double distance_to(const PhantomSource& phantom, Vec3 point) noexcept;

[[nodiscard]] Box bounds_of(const Solid& solid) noexcept;
/// Of the union of solids; for none `low` is above `high`.
[[nodiscard]] Box bounds_of(const std::vector<Solid>& solids) noexcept;

}  // namespace kerf::documents
