// SPDX-License-Identifier: Apache-2.0
#include "bone/import/bone_distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "core/field/grid/box_distance.h"
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

void RememberedBrick::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    if (needed.low < always_.low || needed.high > always_.high) return distance_->fill(lattice, needed, distances);
    if (lattice_ != lattice) {
        distance_->fill(lattice, always_, distances_);
        lattice_ = lattice;
    }
    std::copy(distances_.begin(), distances_.end(), distances.begin());
}

PhantomDistance::PhantomDistance(std::vector<documents::PhantomPart> parts) : parts_(std::move(parts)) {
    for (const documents::PhantomPart& part : parts_) bounds_.push_back(documents::bounds_of(part.solid));
    near_.reserve(parts_.size());
}

double PhantomDistance::reach_of_near(DistanceRange needed) const noexcept {
    double reach = std::max(needed.high, -needed.low);
    for (std::size_t n = 1; n < near_.size(); ++n) reach = std::max(reach, parts_[near_[n]].blend);
    return reach;
}

void PhantomDistance::find_near(Vec3 p, double radius, DistanceRange needed) {
    near_.resize(parts_.size());
    std::iota(near_.begin(), near_.end(), std::size_t{0});
    const auto keep_within = [&](const auto& distance) {
        const double reach = reach_of_near(needed) + radius;
        std::erase_if(near_, [&](std::size_t n) { return distance(n) > reach; });
    };
    keep_within([&](std::size_t n) { return kerf::distance_to(bounds_[n], p); });
    if (radius > 0.0 && near_.size() > 1)
        keep_within([&](std::size_t n) {
            constexpr double overestimate = 1.05;  // [–] that a solid's distance may have
            return documents::distance_to(parts_[n].solid, p) / overestimate;
        });
    limit_ = reach_of_near(needed);
}

double PhantomDistance::distance_to_near(Vec3 p) const noexcept {
    double distance = HUGE_VAL;
    for (const std::size_t n : near_) distance = documents::joined_with(distance, parts_[n], p, limit_);
    return distance;
}

double PhantomDistance::at(Vec3 p, DistanceRange needed) {
    find_near(p, 0.0, needed);
    return distance_to_near(p);
}

void PhantomDistance::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    const Vec3 low{lattice.x.front(), lattice.y.front(), lattice.z.front()},
        high{lattice.x.back(), lattice.y.back(), lattice.z.back()};
    find_near(0.5 * (low + high), 0.5 * length(high - low), needed);
    const double reach = limit_;
    // Blocks of 3³ samples: where the middle one is so far out of the range that all are, all take its distance.
    constexpr std::size_t edge = 3;
    static_assert(stored_edge % edge == 0);
    const auto at = [](std::size_t i, std::size_t j, std::size_t k) { return (k * stored_edge + j) * stored_edge + i; };
    for (std::size_t k = 0; k < stored_edge; k += edge)
        for (std::size_t j = 0; j < stored_edge; j += edge)
            for (std::size_t i = 0; i < stored_edge; i += edge) {
                const double in_block =
                    length(Vec3{lattice.x[i + 2] - lattice.x[i], lattice.y[j + 2] - lattice.y[j],
                                lattice.z[k + 2] - lattice.z[k]});  // at least from the middle to a corner
                const Vec3 middle{lattice.x[i + 1], lattice.y[j + 1], lattice.z[k + 1]};
                limit_ = reach + in_block;
                const double there = distance_to_near(middle);
                const bool is_outside = there > needed.high + in_block || there < needed.low - in_block;
                limit_ = reach;
                for (std::size_t n = 0; n < edge * edge * edge; ++n) {
                    const std::size_t x = i + n % edge, y = j + n / edge % edge, z = k + n / (edge * edge);
                    distances[at(x, y, z)] =
                        is_outside ? there : distance_to_near({lattice.x[x], lattice.y[y], lattice.z[z]});
                }
            }
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

TissueBorder::TissueBorder(DistanceSource& face, const documents::Tissue& tissue)
    : face_(&face), tissue_(&tissue), thinnest_(documents::thinnest(tissue)), thickest_(documents::thickest(tissue)) {}

/// A shell of thickness t ends at depth t under the face. The border's distance is depth − t, the face's is −depth.
DistanceRange TissueBorder::of_face(DistanceRange needed) const noexcept {
    return {-(thickest_ + needed.high), -(thinnest_ + needed.low)};
}

double TissueBorder::at(Vec3 p, DistanceRange needed) {
    return distance_to(*tissue_, tissue_->thickness > 0.0 ? -face_->at(p, of_face(needed)) : 0.0, p);
}

void TissueBorder::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    const bool has_shell = tissue_->thickness > 0.0;
    if (has_shell) face_->fill(lattice, of_face(needed), distances);
    std::size_t n = 0;
    for (const double z : lattice.z)
        for (const double y : lattice.y)
            for (const double x : lattice.x) {
                const double depth = -distances[n];
                if (has_shell && depth - thickest_ > needed.high)
                    distances[n] = depth - thickest_;
                else if (has_shell && tissue_->solids.empty() && depth - thinnest_ < needed.low)
                    distances[n] = depth - thinnest_;
                else
                    distances[n] = distance_to(*tissue_, depth, {x, y, z});
                ++n;
            }
}

}  // namespace kerf::bone
