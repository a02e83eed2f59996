// SPDX-License-Identifier: Apache-2.0
// A batch gives every point the bits it would get alone, with either kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/drilled_block.h"
#include "tests/support/scalar_bone_query.h"
#include "tests/support/with_kernel.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double h = 0.25_mm;

/// Points of the tool frame: about the tip, all over the block, on brick and sample borders, at the surface, nowhere.
std::vector<Vec3> questions(const test::DrilledBlock& hole, std::size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const Pose tool_from_body = inverse(hole.at);
    const Grid& g = hole.body.grid();
    constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const double odd[] = {nan, inf, -inf, 1e300, -1e300, 1e-310, 0.0, -0.0, 3e9};
    std::vector<Vec3> points;
    for (std::size_t n = 0; n < count; ++n) switch (n % 6) {
            case 0:
                points.push_back({2.5_mm * unit(random), 2.5_mm * unit(random), 4.0_mm * unit(random)});
                break;
            case 1:
                points.push_back(tool_from_body *
                                 Vec3{9.0_mm * unit(random), 9.0_mm * unit(random), -7.0_mm + 11.0_mm * unit(random)});
                break;
            case 2: {
                const auto border = [&](std::size_t axis) {
                    return brick_edge * static_cast<int>(0.5 * (1.0 + unit(random)) * g.bricks[axis]);
                };
                const double beside = n % 4 == 0 ? 0.0 : 1e-15 * unit(random);
                points.push_back(tool_from_body *
                                 (g.sample_position(border(0), border(1), border(2)) + Vec3{beside, 0, beside}));
                break;
            }
            case 3: {
                const double angle = 3.2 * unit(random);
                points.push_back(
                    {1.55_mm * std::cos(angle), 1.55_mm * std::sin(angle), -6.0_mm + 7.0_mm * unit(random)});
                break;
            }
            case 4:
                points.push_back(tool_from_body * Vec3{6.0_mm * unit(random), 6.0_mm * unit(random),
                                                       (n % 4 == 0 ? 0.0_mm : -1.0_mm) + 0.3_mm * unit(random)});
                break;
            default: {
                Vec3 p{1.0_mm * unit(random), 1.0_mm * unit(random), 1.0_mm * unit(random)};
                (n % 3 == 0 ? p.x : n % 3 == 1 ? p.y : p.z) = odd[random() % std::size(odd)];
                points.push_back(p);
            }
        }
    return points;
}

/// What the answers had in them, so that a comparison of nothing with nothing is noticed.
struct Seen {
    int engaged = 0, behind = 0, mixed = 0, normals = 0, pending = 0, air = 0;
};

/// The committed surface is known to the bit. Depths in pending solids are taken in single precision: coordinates of up
/// to 16 mm to a nanometre, their sums to two or three.
void compare_surface(const test::ScalarBoneQuery& scalar, Vec3 point, const kerf_surface_point& answer, Seen& seen) {
    constexpr double tolerance = 4e-9;  // [m]
    const kerf_surface_point committed = scalar.nearest_committed(point);
    const double pending = scalar.deepest_pending(point);
    if (!(pending > committed.distance - tolerance)) {
        ASSERT_EQ(std::memcmp(&committed, &answer, sizeof answer), 0)
            << "distance " << committed.distance << " and " << answer.distance;
        return;
    }
    ASSERT_NEAR(answer.distance, std::max(pending, committed.distance), tolerance);
    if (pending < committed.distance + tolerance) return;  // either of them
    ++seen.pending;
    const double clamp = scalar.body.grid().clamp();
    if (std::abs(pending - clamp) < tolerance) return;
    ASSERT_EQ(answer.body, pending < clamp ? 0 : -1);
    if (pending < clamp) {
        ASSERT_TRUE(scalar.is_pending_normal(point, answer.normal, pending, 2.0 * tolerance));
    } else {
        ASSERT_EQ(dot(answer.normal, answer.normal), 0.0);
    }
}

void compare_with(const BlockKernel& kernel, const test::DrilledBlock& hole, std::size_t count, Seen& seen) {
    const test::WithKernel with(kernel);
    const test::ScalarBoneQuery scalar{hole.body, hole.committed, hole.tracker, hole.at};
    const std::vector<Vec3> points = questions(hole, count);
    const Vec3 direction = normalized(Vec3{0.1, 0.2, 1.0});
    std::vector<kerf_bone_sample> samples(count), each_its_way(count);
    std::vector<kerf_surface_point> nearest(count);
    hole.view.sample(points.data(), static_cast<std::uint32_t>(count), direction, samples.data());
    hole.view.nearest(points.data(), static_cast<std::uint32_t>(count), nearest.data());
    std::vector<Vec3> directions;
    for (std::size_t i = 0; i < count; ++i)
        directions.push_back(
            normalized(Vec3{i % 3 == 0 ? 1.0 : 0.1, i % 5 == 0 ? -1.0 : 0.2, i % 2 == 0 ? 1.0 : -1.0}));
    hole.view.sample(points.data(), static_cast<std::uint32_t>(count), Directions::each(directions.data()),
                     each_its_way.data());
    for (std::size_t i = 0; i < count; ++i) {
        const kerf_bone_sample sample = scalar.sample(points[i], direction);
        ASSERT_EQ(std::memcmp(&sample, &samples[i], sizeof sample), 0)
            << kernel.name << ' ' << i << ": engagement " << sample.engagement << " and " << samples[i].engagement
            << ", gap " << sample.gap << " and " << samples[i].gap;
        const kerf_bone_sample its_way = scalar.sample(points[i], directions[i]);
        ASSERT_EQ(std::memcmp(&its_way, &each_its_way[i], sizeof its_way), 0)
            << kernel.name << ' ' << i << ": its own way " << its_way.gap << " and " << each_its_way[i].gap;
        compare_surface(scalar, points[i], nearest[i], seen);
        if (::testing::Test::HasFatalFailure()) FAIL() << kernel.name << ' ' << i;
        kerf_surface_point alone;
        hole.view.nearest(&points[i], 1, &alone);
        ASSERT_EQ(std::memcmp(&alone, &nearest[i], sizeof alone), 0)
            << kernel.name << ' ' << i << ": distance " << alone.distance << " and " << nearest[i].distance;
        seen.engaged += sample.engagement > 0.0;
        seen.behind += sample.gap > 0.0;
        seen.mixed += sample.weight[0] > 0.0 && sample.weight[1] > 0.0;
        seen.normals += dot(nearest[i].normal, nearest[i].normal) > 0.5;
        seen.air += sample.engagement == 0.0;
    }
}

/// Where there is no AVX2, the portable kernel is all there is.
void compare(const test::DrilledBlock& hole, std::size_t count, Seen& seen) {
    compare_with(portable_kernel(), hole, count, seen);
    Seen again;
    if (avx2_kernel() != nullptr) compare_with(*avx2_kernel(), hole, count, again);
}

TEST(BatchQuery, GivesTheScalarBitsWhileCuttingAndAfterTurningBack) {
    Seen seen;
    test::DrilledBlock hole(h);
    compare(hole, 1200, seen);  // nothing cut, nothing pending

    hole.move(6.0_mm, 0.0, 4000, true);
    ASSERT_GT(hole.tracker.solid_count(), hole.tracker.pending_count()) << "the open stretch is one of them";
    compare(hole, 6000, seen);

    hole.move(6.1_mm, 0.04, 200, true);  // turning: the pending poses are not parallel
    ASSERT_GT(hole.tracker.pending_count(), 4u);
    compare(hole, 6000, seen);

    hole.move(5.7_mm, 0.02, 100, false);  // back: the gap is that to the deepest of them
    compare(hole, 6000, seen);

    hole.tracker.flush();
    compare(hole, 1200, seen);

    EXPECT_GT(seen.engaged, 5000);
    EXPECT_GT(seen.behind, 100);
    EXPECT_GT(seen.mixed, 100);
    EXPECT_GT(seen.normals, 2000);
    EXPECT_GT(seen.pending, 200);
    EXPECT_GT(seen.air, 3000);
}

TEST(BatchQuery, GivesTheScalarBitsWithinAndBeyondARegion) {
    Seen seen;
    test::DrilledBlock hole(h, test::nearest_samples(h, {-3.0_mm, -1.0_mm, -4.0_mm}, {0.5_mm, 4.0_mm, 3.0_mm}));
    hole.move(3.6_mm, 0.02, 3000, true);
    compare(hole, 6000, seen);
    hole.move(6.0_mm, 0.03, 2000, true);  // on, beyond the region's lower face
    compare(hole, 6000, seen);
    EXPECT_GT(seen.pending, 50);
    EXPECT_GT(seen.normals, 500);
}

TEST(BatchQuery, GivesTheScalarBitsForAnyNumberOfPoints) {
    test::DrilledBlock hole(h);
    hole.move(4.0_mm, 0.01, 2000, true);
    Seen seen;
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{5},
                                    std::size_t{15}, std::size_t{63}, std::size_t{64}, std::size_t{65},
                                    block_capacity - 1, block_capacity, block_capacity + 1, block_capacity + 73})
        compare(hole, count, seen);
}

}  // namespace
}  // namespace kerf
