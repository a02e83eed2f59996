// SPDX-License-Identifier: Apache-2.0
// Distances to a phantom for the field, against the plain distance to all of its parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bone/import/bone_distances.h"
#include "documents/solids.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;
using documents::PhantomPart;

documents::LoftSolid canal() {
    documents::LoftSolid loft{.sections = {{{0, 20.0_mm, -(40.0_mm)}, 22.0_mm, 16.0_mm, 2.0, 0.6},
                                           {{0, 20.0_mm, 40.0_mm}, 22.0_mm, 16.0_mm, 2.0, 0.6}},
                              .up = {0, 1, 0}};
    lay_path(loft);
    return loft;
}

documents::LoftSolid body() {
    documents::LoftSolid loft{.sections = {{{0, 0, -(13.0_mm)}, 48.0_mm, 35.0_mm, 2.2},
                                           {{0, 1.0_mm, -(4.0_mm)}, 40.0_mm, 32.0_mm, 2.2},
                                           {{0, 0, 13.0_mm}, 45.0_mm, 35.0_mm, 2.2}},
                              .up = {0, -1, 0},
                              .rim = 1.5_mm};
    lay_path(loft);
    return loft;
}

/// Parts of each kind, added and taken away, with and without a fillet.
std::vector<PhantomPart> parts() {
    return {{"body", body()},
            {"hollow",
             documents::SuperellipsoidSolid{
                 .centre = {0, 0, 27.0_mm}, .length = 30.0_mm, .width = 78.0_mm, .height = 60.0_mm},
             true, "", 2.0_mm},
            {"pedicle",
             documents::EllipticTubeSolid{
                 {-20.0_mm, 34.0_mm, 5.0_mm}, {-14.0_mm, 12.0_mm, 5.0_mm}, 10.0_mm, 15.0_mm, {0, 0, 1}},
             false, "", 4.0_mm},
            {"facet", documents::BoxSolid{{-21.0_mm, 34.0_mm, 3.0_mm}, {15.0_mm, 8.0_mm, 26.0_mm}}},
            {"ball", documents::SphereSolid{{10.0_mm, 32.0_mm, 0}, 6.0_mm}, false, "", 1.0_mm},
            {"canal", canal(), true, "", 1.0_mm}};
}

/// Within the range both are the same, but for the error of a tapered section's lower bound.
void expect_same(double found, double right, DistanceRange needed) {
    const auto in_range = [&](double distance) { return std::clamp(distance, needed.low, needed.high); };
    ASSERT_NEAR(in_range(found), in_range(right), 0.01_mm);
}

TEST(PhantomDistance, IsThatToAllPartsInTheNeededRange) {
    PhantomDistance source(parts());
    const documents::PhantomSource all{.parts = parts()};
    const Grid grid = Grid::covering({-35.0_mm, -30.0_mm, -30.0_mm}, {35.0_mm, 50.0_mm, 40.0_mm}, 0.5_mm);
    std::array<double, stored_samples> distances{};
    std::uint64_t state = 1;
    const auto below = [&](int count) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<int>((state >> 33) % static_cast<std::uint64_t>(count));
    };
    for (int n = 0; n < 150; ++n) {
        const BrickLattice lattice =
            BrickLattice::of(grid, below(grid.bricks[0]), below(grid.bricks[1]), below(grid.bricks[2]));
        for (const DistanceRange needed : {DistanceRange{-(1.0_mm), 1.0_mm}, DistanceRange{-(3.0_mm), 0.0}}) {
            source.fill(lattice, needed, distances);
            std::size_t sample = 0;
            for (const double z : lattice.z)
                for (const double y : lattice.y)
                    for (const double x : lattice.x) {
                        const double right = distance_to(all, {x, y, z});
                        ASSERT_NO_FATAL_FAILURE(expect_same(distances[sample++], right, needed))
                            << x << ' ' << y << ' ' << z;
                    }
            const Vec3 corner{lattice.x[0], lattice.y[0], lattice.z[0]};
            ASSERT_NO_FATAL_FAILURE(expect_same(source.at(corner, needed), distance_to(all, corner), needed));
        }
    }
}

TEST(PhantomDistance, IsExactWithoutARange) {
    PhantomDistance source(parts());
    const documents::PhantomSource all{.parts = parts()};
    for (double x = -40.0_mm; x <= 40.0_mm; x += 7.0_mm)
        for (double y = -40.0_mm; y <= 60.0_mm; y += 7.0_mm)
            for (double z = -40.0_mm; z <= 40.0_mm; z += 7.0_mm)
                ASSERT_EQ(source.at({x, y, z}, {}), distance_to(all, {x, y, z})) << x << ' ' << y << ' ' << z;
}

}  // namespace
}  // namespace kerf::bone
