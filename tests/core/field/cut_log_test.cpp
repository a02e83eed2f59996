// SPDX-License-Identifier: Apache-2.0
// Resolutions R2: who stamps when, and how much waits.
#include "core/field/cut/cut_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

/// A drill in a block, moved by hand; its log, and the field that a worker stamps at once.
struct Cutting {
    double h;
    Body body = test::block({-5.0_mm, -5.0_mm, -10.0_mm}, {5.0_mm, 5.0_mm, 0}, h, {0.4, 0.2, 0.7});
    ToolSolid tool = test::drill_outline(1.6_mm, 59.0_deg, 2.0_mm);
    CutField committed{body, 512}, exact{body, 512};
    CutTracker tracker{body, tool, committed};
    std::vector<CutRecord> log;
    std::uint64_t tick = 0;
    bool has_worker = true;  ///< stamps the exact field

    explicit Cutting(double spacing, const Pose& start) : h(spacing) { tracker.restart(start); }

    void move_to(const Pose& to) { keep(tracker.advance(to, tick++)); }
    void end() {
        keep(tracker.close(tick));
        tracker.flush();
    }

private:
    void keep(int closed) {
        for (int i = 0; i < closed; ++i) {
            log.push_back(tracker.closed(i));
            if (log.back().removes && has_worker) exact.stamp(log.back(), tool);
        }
    }
};

/// Down into the block, with turns, withdrawals and tilts, at speeds from creeping to 0.3 m/s.
std::vector<Pose> winding_path(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Pose> path;
    Vec3 tip{0, 0, 1.5_mm}, tilt{0, 0, 0}, velocity{0, 0, -5.0_mm_per_s};
    for (int i = 0; i < 600; ++i) {
        if (i % 60 == 0) {
            const double fast = i % 240 == 180 ? 0.3 : 0.02;  // [m/s]
            const bool is_down = tip.z > -3.0_mm || unit(random) > 0.3;
            velocity = fast * normalized(Vec3{0.3 * unit(random), 0.3 * unit(random), is_down ? -1.0 : 1.0});
        }
        const Vec3 next = tip + 1e-3 * velocity;
        if (next.z > -7.0_mm && next.z < 2.0_mm && std::abs(next.x) < 2.0_mm && std::abs(next.y) < 2.0_mm) tip = next;
        tilt = 0.98 * tilt + 0.004 * Vec3{unit(random), unit(random), 0};
        path.push_back(test::pointing(tip, Vec3{tilt.x, tilt.y, -1.0}));
    }
    return path;
}

TEST(CutLog, NeitherLagNorBatchesNorOrderChangeABit) {
    const std::vector<Pose> path = winding_path(5);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        // Given a haptic side that comes to commit only now and then, even later than its list can hold, and a worker
        // that stamps what has piled up, whenever
        std::mt19937 random(seed);
        Cutting cutting(0.4_mm, path.front());
        CutField worker(cutting.body, 1);
        std::size_t applied = 0, largest_batch = 0, max_pending = 0;
        const auto stamp = [&](std::size_t count) {
            count = std::min(count, cutting.log.size() - applied);
            largest_batch = std::max(largest_batch, count);
            for (const std::size_t end = applied + count; applied < end; ++applied)
                if (cutting.log[applied].removes) worker.stamp(cutting.log[applied], cutting.tool);
        };
        unsigned idle = 0;
        for (std::size_t i = 0; i < path.size(); ++i) {
            const Pose& pose = path[i];
            cutting.move_to(pose);
            if (++idle > 200 || random() % (i / 150 == 2 ? 400 : 3) == 0) {
                cutting.tracker.commit_passed(pose, random() % 2 == 0);
                idle = 0;
            }
            max_pending = std::max(max_pending, cutting.tracker.pending_count());
            if (random() % 17 == 0) stamp(random() % 50);
        }
        cutting.end();
        stamp(cutting.log.size());

        // Then all fields are equal, and so are those of whoever stamps the log again, in whatever order
        ASSERT_TRUE(cutting.committed.same_bits(cutting.exact)) << seed;
        ASSERT_TRUE(worker.same_bits(cutting.exact)) << seed;
        std::shuffle(cutting.log.begin(), cutting.log.end(), random);
        CutField replayed(cutting.body, 1);
        for (const CutRecord& record : cutting.log)
            if (record.removes) replayed.stamp(record, cutting.tool);
        ASSERT_TRUE(replayed.same_bits(cutting.exact)) << seed;
        EXPECT_EQ(replayed.hash(), cutting.exact.hash());

        EXPECT_GT(largest_batch, 20u);
        EXPECT_GT(max_pending, CutTracker::pending_limit) << "there was a lag";
        EXPECT_FALSE(replayed.same_bits(CutField(cutting.body, 1)));
    }
}

// S-12: back at the front its edges would lie on the border of what is committed, and read half of the bone.
TEST(CutLog, DrawnBackAToolHasNotPassedWhatItCutLast) {
    const auto at = [](double x, double depth) { return test::pointing({x, 0, -depth}, {0, 0, -1}); };
    const auto waiting_after = [&](double x, double depth) {
        Cutting cutting(0.4_mm, at(0.0, -1.0_mm));
        const auto go = [&](const Pose& to) {
            cutting.move_to(to);
            for (int i = 0; i < 200; ++i) cutting.tracker.commit_passed(to, true);
        };
        for (double z = -1.0_mm; z < 4.0_mm; z += 0.02_mm) go(at(0.0, z));
        go(at(x, depth));
        return cutting.tracker.pending_count();
    };
    const std::size_t in_the_hole = waiting_after(0.0, 3.99_mm);
    EXPECT_GT(in_the_hole, 0u);
    EXPECT_GE(waiting_after(0.0, 2.0_mm), in_the_hole) << "drawn back, whatever its edges meet at the wall";
    EXPECT_LT(waiting_after(1.0_mm, 3.0_mm), in_the_hole) << "drawn back and gone aside";
}

// A round wall is known no better than h²/(8 r): on a coarse grid a drill in its own hole seems to stand in bone all
// the way, and records that took nothing pushed the front out of the list of those that wait.
TEST(CutLog, OutOfItsHoleAndInAgainADrillTakesNothing) {
    const auto at = [](double depth) { return test::pointing({0, 0, -depth}, {0, 0, -1}); };
    for (const double h : {1.0_mm, 0.7_mm, 0.5_mm, 0.25_mm}) {
        Cutting cutting(h, at(-1.0_mm));
        const auto go = [&](double from, double to) {
            const int steps = static_cast<int>(std::abs(to - from) / 0.02_mm);
            for (int i = 1; i <= steps; ++i) {
                const Pose now = at(from + (to - from) * i / steps);
                cutting.move_to(now);
                cutting.tracker.commit_passed(now, to > from);
            }
        };
        go(-1.0_mm, 8.0_mm);
        const std::size_t down = cutting.log.size();
        go(8.0_mm, 1.0_mm);
        go(1.0_mm, 7.9_mm);
        std::size_t removing = 0;  // the first closes what was open at the front
        for (std::size_t i = down + 1; i < cutting.log.size(); ++i) removing += cutting.log[i].removes;
        EXPECT_GT(cutting.log.size(), down + 1) << h;
        EXPECT_EQ(removing, 0u) << h;
        EXPECT_EQ(cutting.tracker.early_commits(), 0u) << h;
    }
}

TEST(CutLog, AScratchOfAFewHundredthsOfAVoxelIsTaken) {
    for (const double h : {1.0_mm, 0.25_mm}) {
        const double deep = 0.05 * h;
        Cutting cutting(h, test::pointing({-3.0_mm, 0, -deep}, {0, 0, -1}));
        for (double depth : {2.0_mm, -1.0_mm})
            cutting.move_to(test::pointing({-3.0_mm, 0, -depth}, {0, 0, -1}));  // deeper than the scratch
        for (double x = -3.0_mm; x < 3.0_mm; x += 0.01_mm) cutting.move_to(test::pointing({x, 0, -deep}, {0, 0, -1}));
        cutting.end();
        std::size_t removing = 0;
        for (const CutRecord& record : cutting.log) removing += record.removes && record.to.position.x > 2.0_mm;
        EXPECT_GT(removing, 0u) << h;
    }
}

TEST(CutLog, ARecordStampedAFewBricksAtATimeGivesTheBitsOfOneStamp) {
    const std::vector<Pose> path = winding_path(7);
    Cutting cutting(0.4_mm, path.front());
    CutField whole(cutting.body, 1), in_pieces(cutting.body, 1);
    std::mt19937 random(2);
    std::size_t pieces = 0, records = 0;
    for (std::size_t i = 0; i < path.size(); i += 7) {  // records of several sub-poses among them
        cutting.move_to(path[i]);
        for (; records < cutting.log.size(); ++records) {
            const CutRecord& record = cutting.log[records];
            const int touched = whole.stamp(record, cutting.tool);
            StampProgress progress;
            int sum = 0;
            for (bool is_done = false; !is_done; ++pieces) {
                const int most = 1 + static_cast<int>(random() % 7);
                int now = 0;
                is_done = in_pieces.stamp_part(record, cutting.tool, most, progress, now);
                ASSERT_LE(now, most);
                sum += now;
            }
            ASSERT_LE(sum, touched);
            ASSERT_TRUE(progress.has_begun());
        }
    }
    EXPECT_TRUE(in_pieces.same_bits(whole));
    EXPECT_EQ(in_pieces.hash(), whole.hash());
    EXPECT_GT(pieces, 3 * records);
}

TEST(CutLog, WhereTheToolTurnsARecordEndsHoweverFarItGoesInThatTick) {
    constexpr double h = 0.5_mm;
    const auto at = [](double x, double depth) { return test::pointing({x, 0, -depth}, {0, 0, -1}); };
    const struct {
        const char* name;
        Pose next;
    } turns[] = {{"a little back", at(0, 2.0_mm + 0.01 * h)},  // less than it came
                 {"back past where the stretch began", at(0, 2.0_mm - 0.7 * h)},
                 {"aside", at(0.7 * h, 2.0_mm + 0.04 * h)},
                 {"aside and back", at(0.7 * h, 2.0_mm - 0.2 * h)}};
    for (const auto& [name, next] : turns) {
        Cutting cutting(h, at(0, -1.0_mm));
        cutting.move_to(at(0, 2.0_mm));  // closes a record
        const Pose deepest = at(0, 2.0_mm + 0.04 * h);
        cutting.move_to(deepest);  // too little for one
        const std::size_t before = cutting.log.size();
        cutting.move_to(next);
        cutting.end();
        ASSERT_GT(cutting.log.size(), before) << name;
        EXPECT_EQ(length(cutting.log[before].to.position - deepest.position), 0.0) << name;
        EXPECT_TRUE(cutting.log[before].removes) << name;
        EXPECT_TRUE(cutting.committed.same_bits(cutting.exact)) << name;
    }
    // Straight on, or round a bend so wide that nothing is left out, one record holds both
    for (const Pose& next : {at(0, 2.0_mm + 0.7 * h), at(0.003 * h, 2.0_mm + 0.7 * h)}) {
        Cutting cutting(h, at(0, -1.0_mm));
        cutting.move_to(at(0, 2.0_mm));
        const std::size_t before = cutting.log.size();
        cutting.move_to(at(0, 2.0_mm + 0.04 * h));
        cutting.move_to(next);
        cutting.end();
        ASSERT_EQ(cutting.log.size(), before + 1);
        EXPECT_EQ(length(cutting.log[before].to.position - next.position), 0.0);
    }
}

// A hand trembles while it feeds: records are straight, and what they say was cut is what was.
TEST(CutLog, AWayThatWindsAboutTheAxisIsFollowed) {
    constexpr double h = 0.2_mm;
    for (const double tremor : {0.0, 0.05 * h, 0.09 * h, 0.15 * h, 0.5 * h}) {
        Cutting cutting(h, test::pointing({0, 0, -1.0_mm}, {0, 0, -1}));
        std::vector<Pose> way;
        for (int i = 0; i <= 2000; ++i) {  // 1 mm/s, once from side to side in half a voxel of depth, and round
            const double turn = 2.0 * pi * i / 100.0;
            way.push_back(test::pointing(
                {tremor * std::sin(turn), 0.5 * tremor * std::sin(2.0 * turn), -1.0_mm - 1.0_um * i}, {0, 0, -1}));
            cutting.move_to(way.back());
        }
        cutting.end();
        // How far behind is the corner, where the drill is widest, ever left in bone?
        double worst = 0.0;
        std::size_t record = 0;
        for (std::size_t i = 0; i < way.size(); ++i) {
            while (record + 1 < cutting.log.size() && cutting.log[record].tick < i) ++record;
            for (int n = 0; n < 8; ++n) {
                const double angle = 0.25 * pi * n;
                const Vec3 corner =
                    way[i] * Vec3{1.6_mm * std::cos(angle), 1.6_mm * std::sin(angle), cutting.tool.outline()[1].z};
                double least = 1.0;
                for (std::size_t r = record >= 1 ? record - 1 : 0; r < std::min(record + 2, cutting.log.size()); ++r)
                    for (int k = 0; k <= 32; ++k)
                        least = std::min(
                            least, cutting.tool.distance(
                                       inverse(between(cutting.log[r].from, cutting.log[r].to, k / 32.0)) * corner));
                worst = std::max(worst, least);
            }
        }
        EXPECT_LE(worst, 0.06 * h) << tremor;
        if (tremor == 0.0) {
            EXPECT_LE(cutting.log.size(), 11u) << "a record for each voxel of the way";
        }
    }
}

TEST(CutLog, StampingIsSpreadOverTicksAndKeepsUp) {
    // Given a drill that is fed at 1 mm/s into a grid so fine that a record touches more bricks than a tick may stamp
    Cutting cutting(0.1_mm, test::pointing({0, 0, 2.0_mm}, {0, 0, -1}));
    int largest = 0;
    std::size_t max_pending = 0;
    for (int i = 0; i < 4000; ++i) {
        const Pose pose = test::pointing({0, 0, 2.0_mm - 1.0_um * i}, {0, 0, -1});
        cutting.move_to(pose);
        cutting.tracker.commit_passed(pose, true);
        largest = std::max(largest, cutting.tracker.last_bricks());
        max_pending = std::max(max_pending, cutting.tracker.pending_count());
    }
    const int touched = CutField(cutting.body, 1).stamp(cutting.log.back(), cutting.tool);

    // Then no tick stamps a whole record, none is committed early, and little more than a voxel's records are pending
    EXPECT_GT(touched, CutTracker::bricks_per_tick);
    EXPECT_LE(largest, CutTracker::bricks_per_tick);
    EXPECT_LT(largest, touched);
    EXPECT_EQ(cutting.tracker.early_commits(), 0u);
    EXPECT_LE(max_pending, 7u);
    cutting.end();
    EXPECT_TRUE(cutting.committed.same_bits(cutting.exact));
}

TEST(CutLog, HoweverMuchWaitsATickStampsNoMoreThanItMay) {
    // Given a cut through bone at 0.3 m/s, on a grid where that is 150 bricks a tick and more, and nobody to commit it
    // for a while
    Cutting cutting(0.1_mm, test::pointing({-3.0_mm, 0, -3.0_mm}, {0, 0, -1}));
    const auto at = [](int i) { return test::pointing({-3.0_mm + 0.05_mm * std::min(i, 80), 0, -3.0_mm}, {0, 0, -1}); };
    for (int i = 0; i < 70; ++i) cutting.move_to(at(i));
    ASSERT_TRUE(cutting.tracker.is_behind());

    // When the loop comes to it
    int ticks = 0;
    for (; cutting.tracker.is_behind() && ticks < 1000; ++ticks) {
        cutting.move_to(at(70 + ticks));
        cutting.tracker.commit_passed(at(70 + ticks), false);
        ASSERT_LE(cutting.tracker.last_bricks(), CutTracker::max_bricks + 1);
        ASSERT_GT(cutting.tracker.last_bricks(), 0);
    }
    // Then it has caught up after a while, the bits are those of stamping at once, and what was left is spread as well
    EXPECT_GT(ticks, 5);
    EXPECT_LT(ticks, 1000);
    EXPECT_GT(cutting.tracker.early_commits(), 0u);
    for (int i = 0; i < 20; ++i) {
        cutting.tracker.commit_passed(at(80), true, 7);
        ASSERT_LE(cutting.tracker.last_bricks(), 8);
    }
    cutting.end();
    EXPECT_TRUE(cutting.committed.same_bits(cutting.exact));
}

TEST(CutLog, ScribblingOnTheSpotKeepsThePendingListShort) {
    // Ten seconds within 0.3 voxels of one place: along the axis, across it, round and round, and while creeping deeper
    struct Scribble {
        const char* name;
        Vec3 reach;    // [voxels]
        double tilt;   // [rad]
        double creep;  // [voxels] in all
    };
    const Scribble scribbles[] = {{"along", {0, 0, 0.3}, 0.0, 0.0},
                                  {"across", {0.3, 0, 0}, 0.0, 0.0},
                                  {"tilting", {0.2, 0.2, 0.2}, 0.02, 0.0},
                                  {"creeping", {0.3, 0.3, 0.3}, 0.0, 0.9}};
    constexpr double h = 0.5_mm;
    for (const auto& [name, reach, tilt, creep] : scribbles) {
        std::mt19937 random(9);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        const auto pose_at = [&](Vec3 voxels, double depth, Vec3 lean) {
            return test::pointing(h * voxels + Vec3{0, 0, -depth}, Vec3{lean.x, lean.y, -1.0});
        };
        Cutting cutting(h, pose_at({0, 0, 0}, -1.0_mm, {0, 0, 0}));
        for (int i = 1; i <= 100; ++i) {
            const Pose pose = pose_at({0, 0, 0}, -1.0_mm + 0.04_mm * i, {0, 0, 0});
            cutting.move_to(pose);
            cutting.tracker.commit_passed(pose, true);
        }
        std::size_t most = 0;
        const std::size_t before = cutting.log.size();
        cutting.has_worker = false;
        for (int i = 0; i < 10000; ++i) {
            const Vec3 at{reach.x * unit(random), reach.y * unit(random), reach.z * unit(random)};
            const Vec3 lean{tilt * unit(random), tilt * unit(random), 0};
            const Pose pose = pose_at(at, 3.0_mm + h * creep * i / 10000, lean);
            cutting.move_to(pose);
            cutting.tracker.commit_passed(pose, i % 2 == 0);
            most = std::max(most, cutting.tracker.pending_count());
            // Those that one tick closed more, for as long as their bricks are more than a tick may stamp
            ASSERT_LE(most, CutTracker::pending_limit + 2) << name << ", spacing " << h << ", tick " << i;
        }
        EXPECT_GT(cutting.log.size() - before, 5000u) << name << ": the scribble is in the log";
    }
}

}  // namespace
}  // namespace kerf
