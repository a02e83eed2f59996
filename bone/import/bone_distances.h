// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "bone/surface/mesh_distances.h"
#include "core/field/grid/distance_source.h"
#include "core/field/grid/region.h"
#include "documents/anatomy.h"

/// Distance sources for the fields of a bone, composed of other sources.
namespace kerf::bone {

/// Returns a source as a plain function, exact everywhere. Pre: `source` outlives it.
[[nodiscard]] inline std::function<double(Vec3)> as_function(DistanceSource& source) {
    return [&source](Vec3 p) { return source.at(p, {}); };
}

/// Distance to a bone that continues beyond a region as it is at the region's face.
class InRegion final : public DistanceSource {
public:
    /// Pre: both outlive it. The region may change.
    InRegion(DistanceSource& distance, const Region& region) : distance_(&distance), region_(&region) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    DistanceSource* distance_;
    const Region* region_;
};

/// The same distance. It remembers the last brick, for sources that sample the same brick one after the other.
class RememberedBrick final : public DistanceSource {
public:
    /// @param always   the range in which a brick is sampled
    /// Pre: `distance` outlives it.
    RememberedBrick(DistanceSource& distance, DistanceRange always) : distance_(&distance), always_(always) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override { return distance_->at(p, needed); }
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    DistanceSource* distance_;
    DistanceRange always_;
    std::optional<BrickLattice> lattice_;
    std::array<double, stored_samples> distances_{};
};

/// Distance to a phantom. It samples only the parts that can change a distance in the needed range.
class PhantomDistance final : public DistanceSource {
public:
    explicit PhantomDistance(std::vector<documents::PhantomPart> parts);
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    /// Lists in `near_` the parts that matter within `radius` of a point, and sets `limit_`.
    void find_near(Vec3 p, double radius, DistanceRange needed);
    /// Returns how far from a part a distance can depend on it: as far as the range, or as a fillet of near parts.
    [[nodiscard]] double reach_of_near(DistanceRange needed) const noexcept;
    [[nodiscard]] double distance_to_near(Vec3 p) const noexcept;

    std::vector<documents::PhantomPart> parts_;
    std::vector<Box> bounds_;        ///< [m] of each part
    std::vector<std::size_t> near_;  ///< indices of parts
    double limit_ = 0.0;             ///< [m] up to which their distances are needed exactly
};

/// Distance to the nearest of several surfaces.
class NearestSurface final : public DistanceSource {
public:
    explicit NearestSurface(std::vector<MeshDistances> surfaces) : surfaces_(std::move(surfaces)) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    std::vector<MeshDistances> surfaces_;
};

/// Distance to the bone: its outer surface without its cavities.
class WithoutCavities final : public DistanceSource {
public:
    /// Pre: both outlive it.
    WithoutCavities(DistanceSource& outer, DistanceSource& cavity) : outer_(&outer), cavity_(&cavity) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    DistanceSource *outer_, *cavity_;
};

/// Distance to the border of a tissue other than the base: its shell under a face, its solids, or their intersection.
class TissueBorder final : public DistanceSource {
public:
    /// Pre: both outlive it.
    TissueBorder(DistanceSource& face, const documents::Tissue& tissue);
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override;
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override;

private:
    [[nodiscard]] DistanceRange of_face(DistanceRange needed) const noexcept;
    DistanceSource* face_;
    const documents::Tissue* tissue_;
    double thinnest_, thickest_;  ///< [m] of the shell
};

}  // namespace kerf::bone
