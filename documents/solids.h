// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/grid/box.h"
#include "documents/anatomy.h"

/// Distances to the implicit solids that phantoms and zones are made of.
namespace kerf::documents {

/// Signed distance [m], negative inside; exact for box, tube and sphere, a lower bound outside an elliptic tube. [any]
/// pure.
[[nodiscard]] double distance_to(const Solid& solid, Vec3 point) noexcept;

/// To the union of solids; +infinity for none.
[[nodiscard]] double distance_to_any(const std::vector<Solid>& solids, Vec3 point) noexcept;

/// To where a tissue is, which is no base [m]: its shell, its solids, or what both have in common.
/// @param depth  [m] of the place under the surface that shells lie under
[[nodiscard]] double distance_to(const Tissue& tissue, double depth, Vec3 point) noexcept;

/// To a phantom: parts united and subtracted in their order.
[[nodiscard]] double distance_to(const PhantomSource& phantom, Vec3 point) noexcept;

[[nodiscard]] Box bounds_of(const Solid& solid) noexcept;
/// Of the union of solids; for none `low` is above `high`.
[[nodiscard]] Box bounds_of(const std::vector<Solid>& solids) noexcept;

}  // namespace kerf::documents
