// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/procedure/anatomy.h"

/// Distances to the implicit solids that phantoms and zones are made of.
namespace kerf {

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

struct Box {
    Vec3 low{}, high{};
};
/// Whether two boxes have a point in common.   [any] pure.
[[nodiscard]] inline bool meet(const Box& a, const Box& b) noexcept {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}
[[nodiscard]] Box bounds_of(const Solid& solid) noexcept;
/// Of the union of solids; for none `low` is above `high`.
[[nodiscard]] Box bounds_of(const std::vector<Solid>& solids) noexcept;

}  // namespace kerf
