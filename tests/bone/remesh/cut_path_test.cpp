// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/cut_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "bone/remesh/swept_before.h"
#include "core/field/cut/sweep.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

/// A blade 14 mm wide and 1.2 mm thick, whose front removes bone 1 mm deep.
ToolSolid blade() { return ToolSolid::prism({{0.0, 6.8_mm}, {-0.2_mm, 7.0_mm}, {-1.0_mm, 7.0_mm}}, 1.2_mm); }

class Path {
public:
    /// Moves the tool's tip to a point in steps of 0.03 mm.
    Path& to(Vec3 point, Vec3 turn = {}) {
        const Pose there{point, quat_from_rotation_vector(turn)};
        const Pose start = at_;
        const int steps = std::max(1, static_cast<int>(std::ceil(length(point - start.position) / 0.03_mm)));
        for (int i = 1; i <= steps; ++i) {
            CutRecord record;
            record.sequence = records.size();
            record.from = at_;
            record.to = i == steps ? there : between(start, there, static_cast<double>(i) / steps);
            at_ = record.to;
            records.push_back(record);
        }
        return *this;
    }
    void jump(Vec3 point) { at_.position = point; }
    std::vector<CutRecord> records;

private:
    Pose at_ = identity_pose();
};

std::vector<CutStretch> stretches(const Path& path, double tolerance = 20e-6) {
    const ToolSolid solid = blade();
    return stretches_of(path.records, {&solid}, tolerance);
}
std::size_t kept(const Path& path) {
    const ToolSolid solid = blade();
    SweptBefore swept({&solid}, 20e-6, 0.5_mm);
    std::size_t count = 0;
    for (const CutStretch& one : stretches_of(path.records, {&solid}, 20e-6)) {
        if (swept.covers(one)) continue;
        swept.add(one);
        ++count;
    }
    return count;
}

TEST(CutPath, JoinsAStraightWay) {
    Path path;
    path.to({0, 0, -10.0_mm});
    const auto joined = stretches(path);
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_TRUE(joined[0].from.position == Vec3{});
    EXPECT_TRUE((joined[0].to.position == Vec3{0, 0, -10.0_mm}));
}
TEST(CutPath, JoinsATurnAsFarAsTheHullOfItsEndsCoversIt) {
    Path path;
    path.to({0, 0, -4.0_mm}, {0, 0, 0.05});
    const auto joined = stretches(path);
    EXPECT_GT(joined.size(), 2U);
    EXPECT_LT(joined.size(), path.records.size());
    for (const CutStretch& one : joined) {
        // The blade's narrow ends, 7 mm from the axis of the turn, leave their chord by less than the tolerance.
        const double half = 0.5 * length(small_rotation_vector(conjugate(one.from.rotation) * one.to.rotation));
        EXPECT_LE(half * 7.0_mm, 2.0 * 20e-6);
    }
}
TEST(CutPath, StartsAnewAtACornerAndWhereThePathTurnsBack) {
    Path path;
    path.to({0, 0, -5.0_mm}).to({3.0_mm, 0, -5.0_mm}).to({0, 0, -5.0_mm});
    EXPECT_EQ(stretches(path).size(), 3U);
}
TEST(CutPath, StartsAnewWhereRecordsDoNotFollowEachOther) {
    Path path;
    path.to({0, 0, -1.0_mm});
    path.jump({0, 0, -2.0_mm});
    path.to({0, 0, -3.0_mm});
    EXPECT_EQ(stretches(path).size(), 2U);
}

TEST(CutPath, StaysWithinItsToleranceOfATremblingHand) {
    std::mt19937 random(7);
    std::normal_distribution<double> tremor(0.0, 15e-6);
    Path path;
    for (int i = 1; i <= 300; ++i) path.to({tremor(random), tremor(random), -0.03_mm * i});
    const ToolSolid solid = blade();
    for (const double tolerance : {5e-6, 20e-6, 100e-6}) {
        const auto joined = stretches(path, tolerance);
        // Every recorded pose lies on some stretch, at most the tolerance away.
        for (const CutRecord& record : path.records) {
            double nearest = HUGE_VAL;
            for (const CutStretch& one : joined)
                for (int n = 0; n <= 200; ++n)
                    nearest = std::min(nearest, largest_motion(solid, between(one.from, one.to, n / 200.0), record.to));
            EXPECT_LE(nearest, tolerance + 25e-6 /* half a step of the search along the longest stretch */);
        }
    }
    EXPECT_LT(stretches(path, 100e-6).size(), stretches(path, 20e-6).size());
    EXPECT_LT(stretches(path, 20e-6).size(), path.records.size());
}

TEST(CutPath, LeavesOutTheWayBackThroughTheSlot) {
    Path path;
    path.to({0, 0, -10.0_mm}).to({0, 0, 0});
    EXPECT_EQ(stretches(path).size(), 2U);
    EXPECT_EQ(kept(path), 1U);
    path.to({0, 0, -10.0_mm});
    EXPECT_EQ(kept(path), 1U);
}
TEST(CutPath, KeepsWhatGoesDeeperOrAsideByMoreThanTheTolerance) {
    Path deeper;
    deeper.to({0, 0, -10.0_mm}).to({0, 0, 0}).to({0, 0, -10.1_mm});
    EXPECT_EQ(kept(deeper), 2U);
    Path aside;
    aside.to({0, 0, -10.0_mm});
    aside.jump({0, 0.05_mm, 0});
    aside.to({0, 0.05_mm, -10.0_mm});
    EXPECT_EQ(kept(aside), 2U);
    Path hardly;
    hardly.to({0, 0, -10.0_mm});
    hardly.jump({0, 0.01_mm, 0});
    hardly.to({0, 0.01_mm, -10.0_mm});
    EXPECT_EQ(kept(hardly), 1U);
}

// ---- as they come -------------------------------------------------------------------------------------------------

std::vector<CutStretch> as_they_come(const Path& path, double longest) {
    const ToolSolid solid = blade();
    StretchJoiner joiner({&solid}, 20e-6, longest);
    std::vector<CutStretch> all;
    for (const CutRecord& record : path.records)
        if (const auto ended = joiner.push(record)) all.push_back(*ended);
    if (const auto ended = joiner.end()) all.push_back(*ended);
    EXPECT_FALSE(joiner.open().has_value());
    return all;
}

TEST(StretchJoiner, EndsAStretchThatWouldBeTooLong) {
    Path path;
    path.to({0, 0, -10.0_mm});
    const auto all = as_they_come(path, 2.0_mm);
    ASSERT_EQ(all.size(), 6u) << "a step of 0.03 mm fits 66 times into 2 mm";
    for (const CutStretch& one : all) EXPECT_LE(length(one.to.position - one.from.position), 2.0_mm + 1e-12);
    for (std::size_t n = 1; n < all.size(); ++n) EXPECT_EQ(length(all[n].from.position - all[n - 1].to.position), 0.0);
    EXPECT_EQ(all.back().to.position.z, -10.0_mm);
}

TEST(StretchJoiner, FollowsTheSameRulesAsAWholeLog) {
    Path path;
    path.to({0, 0, -3.0_mm}).to({2.0_mm, 0, -3.0_mm}).to({0, 0, -3.0_mm});
    path.jump({0, 5.0_mm, 0});
    path.to({0, 5.0_mm, -2.0_mm});
    EXPECT_EQ(as_they_come(path, 1.0).size(), stretches(path).size());
    EXPECT_EQ(as_they_come(path, 1.0).size(), 4u);
}

TEST(StretchJoiner, ShowsTheStretchThatGoesOn) {
    Path path;
    path.to({0, 0, -1.0_mm});
    const ToolSolid solid = blade();
    StretchJoiner joiner({&solid}, 20e-6, 1.0);
    for (const CutRecord& record : path.records) {
        EXPECT_FALSE(joiner.push(record).has_value());
        ASSERT_TRUE(joiner.open().has_value());
        EXPECT_EQ(joiner.open()->to.position.z, record.to.position.z);
    }
}

TEST(SweptBefore, ACopyDoesNotKnowWhatComesAfter) {
    const ToolSolid solid = blade();
    CutStretch cut{identity_pose(), identity_pose(), 0};
    cut.to.position.z = -2.0_mm;
    SweptBefore swept({&solid}, 20e-6, 0.5_mm);
    const SweptBefore before = swept;
    swept.add(cut);
    EXPECT_TRUE(swept.covers(cut));
    EXPECT_FALSE(before.covers(cut));
    swept = before;
    EXPECT_FALSE(swept.covers(cut));
}

}  // namespace
}  // namespace kerf::bone
