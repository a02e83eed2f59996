// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bone/surface/signed_distance.h"
#include "bone/surface/triangle_tree.h"
#include "core/field/grid/distance_source.h"

namespace kerf::bone {

/// Distances to a closed surface, brick by brick. A triangle is compared only with the samples that it may be nearest
/// to. The values are those of `SignedDistance`, bit for bit.
///
/// Distances come from the triangles near a brick, and for each 3³ of its samples from the triangles near these. The
/// minimum does not depend on the order. Signs come from links: no surface passes between two samples if the sum of
/// their distances exceeds the distance between them. One winding number decides for each set of linked samples.
class MeshDistances final : public DistanceSource {
public:
    /// Pre: `tree` outlives it.
    explicit MeshDistances(const TriangleTree& tree) : tree_(&tree), single_(tree) {}

    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    struct Candidate {
        Vec3 a, b, c;
        Vec3 low, high;  ///< bounding box
        double nearest;  ///< [m] to the centre of the samples
    };
    using SampleIndex = std::array<int, 3>;

    void gather(Vec3 centre, double radius, double limit);
    void measure(const BrickLattice& lattice, SampleIndex first, double limit, BrickDistances squares);
    void sign(const BrickLattice& lattice, BrickDistances distances);

    const TriangleTree* tree_;
    SignedDistance single_;
    std::vector<Candidate> of_brick_, of_block_;
    std::array<std::uint16_t, stored_samples> root_{};
};

}  // namespace kerf::bone
