// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "core/field/grid/grid.h"

namespace kerf {

/// The range of distances that a caller needs exactly [m]. For a distance below `low`, a source may return any value
/// below `low`; for one above `high`, any value above `high`.
struct DistanceRange {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    [[nodiscard]] DistanceRange negated() const noexcept { return {-high, -low}; }
};

/// Coordinates of a brick's 9³ samples along each axis, body frame [m], in ascending order; equal ones are allowed.
struct BrickLattice {
    std::array<double, stored_edge> x, y, z;

    bool operator==(const BrickLattice&) const = default;
    static BrickLattice of(const Grid& grid, int i, int j, int k) noexcept {
        BrickLattice lattice{};
        for (int n = 0; n < stored_edge; ++n) {
            const Vec3 p = grid.sample_position(i * brick_edge + n, j * brick_edge + n, k * brick_edge + n);
            const auto at = static_cast<std::size_t>(n);
            lattice.x[at] = p.x;
            lattice.y[at] = p.y;
            lattice.z[at] = p.z;
        }
        return lattice;
    }
};

/// Distances at a brick's 9³ samples [m]; x runs fastest, then y.
using BrickDistances = std::span<double, stored_samples>;

/// A signed distance from which a field is built: body frame [m] → [m], negative inside, 1-Lipschitz.   [main]
class DistanceSource {
public:
    virtual ~DistanceSource() = default;
    /// Returns the distance at a point.
    [[nodiscard]] virtual double at(Vec3 p, DistanceRange needed) = 0;
    /// Writes the distances at all samples of a brick: the same values as `at`, within the needed range.
    virtual void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
        std::size_t n = 0;
        for (const double z : lattice.z)
            for (const double y : lattice.y)
                for (const double x : lattice.x) distances[n++] = at({x, y, z}, needed);
    }
};

/// A plain function as a source.
class FunctionDistance final : public DistanceSource {
public:
    explicit FunctionDistance(std::function<double(Vec3)> distance) : distance_(std::move(distance)) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange /*needed*/) override { return distance_(p); }

private:
    std::function<double(Vec3)> distance_;
};

}  // namespace kerf
