// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/density_field.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "core/field/cut/body_query.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

double linear_density(Vec3 p) { return 600.0 + 3e4 * p.x - 2e4 * p.y + 4e4 * p.z; }  // [kg/m³], p in metres

TEST(DensityField, ReproducesALinearDensity) {
    // P7: float samples leave 6e-8 of the value
    const Body body = test::block({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 5.0_mm}, 0.3_mm, {0.1, 0.5, 0.8});
    const DensityField field = DensityField::build(
        body.grid(), [&](std::size_t brick) { return !body.surface.is_all_air(brick); }, linear_density);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(-5.0_mm, 5.0_mm);
    for (int i = 0; i < 5000; ++i) {
        const Vec3 p{at(random), at(random), at(random)};
        ASSERT_NEAR(field.at(locate(body.grid(), p), -1.0) / linear_density(p), 1.0, 1e-6);
    }
}

TEST(DensityField, IsStoredOnlyWhereItIsNeeded) {
    const Body body = test::block({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 5.0_mm}, 0.5_mm);
    const Vec3 here{1.0_mm, 1.0_mm, 1.0_mm}, other_brick{-4.0_mm, -4.0_mm, -4.0_mm};
    const std::size_t only = locate(body.grid(), here).brick;
    ASSERT_NE(only, locate(body.grid(), other_brick).brick);
    const DensityField field = DensityField::build(
        body.grid(), [&](std::size_t brick) { return brick == only; }, linear_density);

    EXPECT_NEAR(field.at(locate(body.grid(), here), -1.0), linear_density(here), 1e-3);
    EXPECT_EQ(field.at(locate(body.grid(), other_brick), -1.0), -1.0);
    EXPECT_EQ(field.at(locate(body.grid(), {1.0, 0, 0}), -1.0), -1.0) << "outside the grid";
    EXPECT_EQ(DensityField().at(locate(body.grid(), here), -1.0), -1.0);
}

TEST(DensityField, IsWhatAnEdgeIsTold) {
    Body body = test::block({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 5.0_mm}, 0.5_mm);
    body.materials[0].densities = DensityField::build(
        body.grid(), [&](std::size_t brick) { return !body.surface.is_all_air(brick); }, linear_density);
    const ToolSolid tool = test::drill_outline(1.6_mm, 59.0_deg, 3.0_mm);
    CutField committed(body, 1);
    const CutTracker tracker(body, tool, committed);
    const BodyQuery view(body, committed, tracker);
    const Vec3 p{1.3_mm, -2.1_mm, 0.7_mm};
    kerf_bone_sample s;
    view.sample(&p, 1, {0, 0, 1}, &s);
    EXPECT_NEAR(s.density[0], linear_density(p), 1e-6 * linear_density(p));
}

}  // namespace
}  // namespace kerf
