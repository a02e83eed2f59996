// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bone/surface/signed_distance.h"
#include "bone/surface/triangle_tree.h"
#include "core/field/grid/distance_source.h"

namespace kerf {

/// The distance to a closed surface, a brick at a time: a triangle is compared only with the samples it may be nearest
/// to. The values are those of `SignedDistance`, bit for bit.
///
/// Distances come from the triangles near a brick, and for each 3³ of its samples from those near them. The least of
/// them does not depend on their order. Signs come from links: between two samples whose distances sum up to more than
/// the distance between them no surface passes. One winding number for each set of linked samples decides.
class MeshDistances final : public DistanceSource {
public:
    /// `tree` must live longer.
    explicit MeshDistances(const TriangleTree& tree) : tree_(&tree), single_(tree) {}

    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    struct Candidate {
        Vec3 a, b, c;
        Vec3 low, high;  ///< its box
        double nearest;  ///< [m] to the centre of the samples it is a candidate for
    };
    using Places = std::array<int, 3>;

    void gather(Vec3 centre, double radius, double limit);
    void measure(const BrickLattice& lattice, Places first, double limit, BrickDistances squares);
    void sign(const BrickLattice& lattice, BrickDistances distances);

    const TriangleTree* tree_;
    SignedDistance single_;
    std::vector<Candidate> of_brick_, of_block_;
    std::array<std::uint16_t, stored_samples> root_{};
};

}  // namespace kerf
