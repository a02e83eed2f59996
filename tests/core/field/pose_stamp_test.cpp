// SPDX-License-Identifier: Apache-2.0
// Whatever stamping leaves out, in bricks, rows and samples, would not have changed a bit.
#include "core/field/cut/pose_stamp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/block.h"
#include "tests/support/drilled_block.h"
#include "tests/support/scalar_stamp.h"
#include "tests/support/with_kernel.h"

namespace kerf {
namespace {

using namespace literals;

/// A drill that sinks in with a sway, is drawn back and shifted aside: records of a twentieth of a voxel and of
/// several.
std::vector<CutRecord> records(double h) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<CutRecord> all;
    Pose from = test::DrilledBlock::pose(1.0_mm, 0.0);
    for (int n = 0; n < 40; ++n) {
        const double depth = n < 30 ? 1.0_mm + 0.05 * h * n : 3.0_mm + 0.9 * h * (n - 35);
        Pose to = test::DrilledBlock::pose(depth, 0.02 * std::sin(0.3 * n));
        to.position = to.position + (n > 20 ? 0.3 * h : 1e-4 * h) * Vec3{unit(random), unit(random), unit(random)};
        CutRecord record;
        record.from = from;
        record.to = from = to;
        all.push_back(record);
    }
    return all;
}

struct Counts {
    std::size_t full = 0, untouched = 0, wall = 0;
};

void expect_as_sample_by_sample(const Body& body, const ToolSolid& tool, double h, Counts& counts) {
    test::ScalarStamp reference{body, tool};
    for (const auto& record : records(h)) reference.stamp(record);

    for (const BlockKernel* kernel : {&portable_kernel(), avx2_kernel()}) {
        if (kernel == nullptr) continue;
        const test::WithKernel with(*kernel);
        CutField cut(body, 64);
        for (const auto& record : records(h)) cut.stamp(record, tool);
        for (const auto& [index, samples] : reference.bricks) {
            const std::int16_t* stored = cut.stored(index);
            std::size_t full = 0;
            for (int s = 0; s < stored_samples; ++s) {
                const std::int16_t expected = samples[static_cast<std::size_t>(s)];
                const std::int16_t got = stored != nullptr ? stored[s] : std::int16_t{-32767};
                ASSERT_EQ(got, expected) << kernel->name << ": brick " << index << ", sample " << s;
                full += expected == 32767;
                counts.untouched += expected == -32767;
                counts.wall += expected > -16384 && expected < 32767;
            }
            counts.full += full == stored_samples;
        }
    }
}

TEST(PoseStamp, LeavesOutOnlyWhatCannotRise) {
    const double h = 0.1_mm;
    const Body body = test::block({-2.5_mm, -2.5_mm, -4.0_mm}, {2.5_mm, 2.5_mm, 0}, h, {0.31, 0.17, 0.73});
    Counts counts;
    expect_as_sample_by_sample(body, test::drill_outline(1.6_mm, 59.0_deg, 6.0_mm), h, counts);
    EXPECT_GT(counts.full, 5u) << "bricks that nothing can raise";
    EXPECT_GT(counts.wall, 20000u);
    EXPECT_GT(counts.untouched, 20000u);
}

TEST(PoseStamp, LeavesOutOnlyWhatCannotRiseWithinARegion) {
    const double h = 0.2_mm;
    Body body = test::block({-3.0_mm, -3.0_mm, -5.0_mm}, {3.0_mm, 3.0_mm, 0}, h, {0.31, 0.17, 0.73});
    body.region = {body.grid().sample_position(13, 9, 11), body.grid().sample_position(24, 30, 33)};
    // A step drill with a flat front, shorter than its hole
    const ToolSolid tool({{0.0, 0.5_mm}, {-0.4_mm, 1.0_mm}, {-1.5_mm, 1.0_mm}, {-2.0_mm, 2.0_mm}, {-3.5_mm, 2.0_mm}});
    Counts counts;
    expect_as_sample_by_sample(body, tool, h, counts);
    EXPECT_GT(counts.wall, 2000u);
}

TEST(PoseStamp, OfABladeLeavesOutOnlyWhatCannotRise) {
    const double h = 0.2_mm;
    const Body body = test::block({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 0}, h, {0.31, 0.17, 0.73});
    Counts counts;
    expect_as_sample_by_sample(body, test::blade_outline(20.0_mm, 4.0_mm, 1.5_mm, 0.9_mm), h, counts);
    EXPECT_GT(counts.wall, 5000u);
    EXPECT_GT(counts.untouched, 20000u);
}

TEST(PoseStamp, WhatItRemembersChangesNoBit) {
    // Given records stamped in their order, backwards by groups as they are committed, and shuffled
    const double h = 0.2_mm;
    const Body body = test::block({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 0}, h, {0.31, 0.17, 0.73});
    const ToolSolid tools[] = {test::drill_outline(1.6_mm, 59.0_deg, 2.0_mm),
                               test::blade_outline(20.0_mm, 2.0_mm, 1.5_mm, 0.9_mm),
                               ToolSolid({{0.0, 0.5_mm}, {-0.4_mm, 1.0_mm}, {-2.0_mm, 1.2_mm}})};
    std::mt19937 random(11);
    for (const ToolSolid& tool : tools) {
        const std::vector<CutRecord> in_order = records(h);
        test::ScalarStamp reference{body, tool};
        for (const auto& record : in_order) reference.stamp(record);
        for (int way = 0; way < 6; ++way) {
            std::vector<CutRecord> some = in_order;
            const std::ptrdiff_t group = 3 + 2 * way;
            if (way < 3)
                for (auto from = some.begin(); from != some.end();) {
                    const auto to = from + std::min(group, some.end() - from);
                    std::reverse(from, to);
                    from = to;
                }
            else
                std::shuffle(some.begin(), some.end(), random);
            CutField cut(body, 64);
            for (std::size_t n = 0; n < some.size(); ++n) {
                if (n == some.size() / 2) cut = CutField(cut);  // a copy remembers too
                cut.stamp(some[n], tool);
            }
            for (const auto& [index, samples] : reference.bricks)
                for (int s = 0; s < stored_samples; ++s) {
                    const std::int16_t* stored = cut.stored(index);
                    ASSERT_EQ(stored != nullptr ? stored[s] : std::int16_t{-32767},
                              samples[static_cast<std::size_t>(s)])
                        << "way " << way << ", brick " << index << ", sample " << s;
                }
        }
    }
}

TEST(PoseStamp, AnotherSolidIsNotTakenForTheOneBefore) {
    // Given two drills of different widths that stand at the same place one after the other
    const double h = 0.2_mm;
    const Body body = test::block({-3.0_mm, -3.0_mm, -3.0_mm}, {3.0_mm, 3.0_mm, 0}, h);
    CutRecord record;
    record.from = record.to = test::pointing({0, 0, -2.0_mm}, {0, 0, -1});
    CutField both(body, 64), wide(body, 64);
    for (const double radius : {1.0_mm, 1.5_mm}) {
        const ToolSolid tool = test::drill_outline(radius, 59.0_deg, 4.0_mm);  // likely where the other was in memory
        both.stamp(record, tool);
        if (radius == 1.5_mm) wide.stamp(record, tool);
    }
    EXPECT_TRUE(both.same_bits(wide));
}

}  // namespace
}  // namespace kerf
