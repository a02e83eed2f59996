// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "bone/surface/mesh_distances.h"
#include "core/field/grid/distance_source.h"
#include "core/field/grid/region.h"
#include "documents/anatomy.h"

/// The distances that a bone's fields are built from, put together out of others.
namespace kerf {

/// A source as a plain function, exact everywhere. `source` must live longer.
[[nodiscard]] inline std::function<double(Vec3)> as_function(DistanceSource& source) {
    return [&source](Vec3 p) { return source.at(p, {}); };
}

/// Beyond a region the bone continues as it is at the region's face.
class InRegion final : public DistanceSource {
public:
    /// Both must live longer. The region may change.
    InRegion(DistanceSource& distance, const Region& region) : distance_(&distance), region_(&region) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    DistanceSource* distance_;
    const Region* region_;
};

/// To the nearest of several surfaces.
class NearestSurface final : public DistanceSource {
public:
    explicit NearestSurface(std::vector<MeshDistances> surfaces) : surfaces_(std::move(surfaces)) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    std::vector<MeshDistances> surfaces_;
};

/// To the bone: its outside without the rooms in it.
class WithoutRooms final : public DistanceSource {
public:
    /// Both must live longer.
    WithoutRooms(DistanceSource& outer, DistanceSource& room) : outer_(&outer), room_(&room) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    DistanceSource *outer_, *room_;
};

/// To where a tissue is, which is no base: its shell under a face, its solids, or what both have in common.
class TissueBorder final : public DistanceSource {
public:
    /// Both must live longer.
    TissueBorder(DistanceSource& face, const Tissue& tissue) : face_(&face), tissue_(&tissue) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    [[nodiscard]] DistanceRange of_face(DistanceRange needed) const noexcept;
    DistanceSource* face_;
    const Tissue* tissue_;
};

}  // namespace kerf
