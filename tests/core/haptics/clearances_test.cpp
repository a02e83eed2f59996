// SPDX-License-Identifier: Apache-2.0
// Which points of a moving tool have to be asked again, held against all of them.
#include "core/field/clearances.h"

#include <gtest/gtest.h>

#include <random>

#include "core/haptics/live_body.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double h = 0.25_mm;
const ToolSolid drill = test::drill_outline(1.6_mm, 59.0_deg, 3.0_mm);

/// Rings of points on a shaft, thinner than the drill.
std::vector<Vec3> points_of_shaft() {
    std::vector<Vec3> points;
    for (int ring = 0; ring < 25; ++ring)
        for (int n = 0; n < 16; ++n) {
            const double angle = 2.0 * pi * n / 16.0;
            points.push_back({1.5_mm * std::cos(angle), 1.5_mm * std::sin(angle), -1.0_mm - 0.4_mm * ring});
        }
    return points;
}

struct Asked {
    std::size_t of = 0, were = 0, near = 0, missed = 0;
};

/// Goes about in a body, and drills it, asking those that may be near; all of them are looked at besides.
Asked go_about(LiveBody& body, double step, double turn, int ticks) {
    constexpr double margin = 0.1_mm;
    const std::vector<Vec3> points = points_of_shaft();
    std::vector<kerf_surface_point> answers(points.size());
    std::vector<double> committed(points.size());
    Clearances clearances(points.size());
    clearances.begin(points.size());
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Pose at = test::pointing({0.05_mm, 0.02_mm, 2.0_mm}, {0, 0, -1});
    Vec3 to{};
    Asked asked;
    body.tracker.restart(at);
    for (int tick = 0; tick < ticks; ++tick) {
        if (tick % 40 == 0) to = {0.3 * unit(random), 0.3 * unit(random), tick < ticks / 2 ? -1.0 : unit(random)};
        const Pose last = at;
        at.position = at.position + step * to;
        at.rotation = normalized(quat_from_rotation_vector({turn * unit(random), turn * unit(random), 0}) * at.rotation);
        body.tracker.advance(at, static_cast<std::uint64_t>(tick));
        body.committed.reserve(256);
        body.tracker.commit_passed(at, true);
        body.view.place(at);
        clearances.move(body.steepness() * largest_motion(ToolSolid({{0.0, 1.5_mm}, {-11.0_mm, 1.5_mm}}), last, at));

        std::vector<bool> is_due(points.size(), false);
        const auto due = clearances.within(margin);
        for (const std::uint32_t i : due) {
            is_due[i] = true;
            kerf_surface_point answer;
            double clear = 0.0;
            body.view.nearest(&points[i], 1, &answer, &clear);
            clearances.note(i, clear);
        }
        body.view.nearest(points.data(), static_cast<std::uint32_t>(points.size()), answers.data(), committed.data());
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_LE(committed[i], answers[i].distance);
            const bool is_near = answers[i].distance < margin;
            asked.near += is_near;
            asked.missed += is_near && !is_due[i];
        }
        asked.of += points.size();
        asked.were += due.size();
    }
    return asked;
}

TEST(Clearances, MissNoneInAHoleThatIsBeingDrilled) {
    const Body block = test::block({-6.0_mm, -6.0_mm, -9.0_mm}, {6.0_mm, 6.0_mm, 0}, h);
    LiveBody body(0, block, CutField(block, 1024), drill);
    const Asked asked = go_about(body, 4.0_um, 2e-6, 3000);
    EXPECT_EQ(asked.missed, 0u);
    EXPECT_GT(asked.near, 1000u);
    EXPECT_LT(asked.were - asked.near, asked.of / 10) << "beside those that are near";
}

TEST(Clearances, MissNoneWhereARegionEnds) {
    Body block = test::block({-6.0_mm, -6.0_mm, -9.0_mm}, {6.0_mm, 6.0_mm, 0}, h);
    const Vec3 origin = block.grid().origin;
    const auto sample = [&](Vec3 p) {
        const Vec3 at = (1.0 / h) * (p - origin);
        return block.grid().sample_position(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z));
    };
    block.region = {sample({-4.0_mm, -1.0_mm, -4.0_mm}), sample({4.0_mm, 4.0_mm, 3.0_mm})};  // a face through the hole, another across it
    LiveBody body(0, block, CutField(block, 1024), drill);
    const Asked asked = go_about(body, 4.0_um, 2e-6, 3000);
    EXPECT_EQ(asked.missed, 0u);
    EXPECT_GT(asked.near, 1000u);
}

TEST(Clearances, ForgetWhatTheyKnewWhenTold) {
    Clearances clearances(200);
    clearances.begin(130);
    EXPECT_EQ(clearances.within(0.0).size(), 130u);
    for (std::uint32_t i = 0; i < 130; ++i) clearances.note(i, i == 77 ? 0.2 : 1.0);
    EXPECT_EQ(clearances.within(0.1).size(), 0u);
    clearances.move(0.15);
    const auto due = clearances.within(0.1);
    ASSERT_EQ(due.size(), 1u);
    EXPECT_EQ(due[0], 77u);
    clearances.note(77, 3.0);
    clearances.move(0.7);
    EXPECT_EQ(clearances.within(0.1).size(), 0u);
    clearances.forget();
    EXPECT_EQ(clearances.within(0.1).size(), 130u);
}

}  // namespace
}  // namespace kerf
