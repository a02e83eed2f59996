// SPDX-License-Identifier: Apache-2.0
#include "bone/import/bone_distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "documents/solids.h"

namespace kerf::bone {
namespace {

using Samples = std::array<double, stored_samples>;

}  // namespace

double InRegion::at(Vec3 p, DistanceRange needed) { return distance_->at(region_->nearest(p), needed); }

void InRegion::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    BrickLattice inside = lattice;
    for (double& x : inside.x) x = std::clamp(x, region_->low.x, region_->high.x);
    for (double& y : inside.y) y = std::clamp(y, region_->low.y, region_->high.y);
    for (double& z : inside.z) z = std::clamp(z, region_->low.z, region_->high.z);
    distance_->fill(inside, needed, distances);
}

double NearestSurface::at(Vec3 p, DistanceRange needed) {
    double nearest = HUGE_VAL;
    for (MeshDistances& one : surfaces_) nearest = std::min(nearest, one.at(p, needed));
    return nearest;
}

void NearestSurface::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    std::fill(distances.begin(), distances.end(), HUGE_VAL);
    Samples one{};
    for (MeshDistances& surface : surfaces_) {
        surface.fill(lattice, needed, one);
        for (std::size_t n = 0; n < one.size(); ++n) distances[n] = std::min(distances[n], one[n]);
    }
}

double WithoutCavities::at(Vec3 p, DistanceRange needed) {
    return std::max(outer_->at(p, needed), -cavity_->at(p, needed.negated()));
}

void WithoutCavities::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    Samples cavity{};
    outer_->fill(lattice, needed, distances);
    cavity_->fill(lattice, needed.negated(), cavity);
    for (std::size_t n = 0; n < cavity.size(); ++n) distances[n] = std::max(distances[n], -cavity[n]);
}

/// A shell of thickness t ends at depth t under the face. The border's distance is depth − t, the face's is −depth.
DistanceRange TissueBorder::of_face(DistanceRange needed) const noexcept {
    return {-(tissue_->thickness + needed.high), -(tissue_->thickness + needed.low)};
}

double TissueBorder::at(Vec3 p, DistanceRange needed) {
    return distance_to(*tissue_, tissue_->thickness > 0.0 ? -face_->at(p, of_face(needed)) : 0.0, p);
}

void TissueBorder::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    if (tissue_->thickness > 0.0) face_->fill(lattice, of_face(needed), distances);
    std::size_t n = 0;
    for (const double z : lattice.z)
        for (const double y : lattice.y)
            for (const double x : lattice.x) {
                distances[n] = distance_to(*tissue_, -distances[n], {x, y, z});
                ++n;
            }
}

}  // namespace kerf::bone
