// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "core/field/bone_surface.h"
#include "core/haptics/surface_worker.h"
#include "tests/support/loop_guard.h"
#include "tests/support/mill.h"

namespace kerf {
namespace {

using namespace literals;

struct Milled {
    Body body = test::bar(0.2_mm);
    ToolSetup setup = test::mill();
    ToolOutline outline = made(setup);
    Simulation simulation{body, setup, outline, gains_for(*find_device("premium-1.5-6dof"), 0.1), test::mill_at(-3.0_mm)};
    double x = -3.0_mm;

    static ToolOutline made(const ToolSetup& setup) {
        ToolOutline outline;
        std::string error;
        EXPECT_TRUE(outline_of(setup, outline, error)) << error;
        return outline;
    }
    /// One tick of the hand on its way along x, 2 µm.
    TickResult go(double y = 2.0_mm) {
        x += 2.0_um;
        return simulation.tick({test::mill_at(x, y)});
    }
};

double volume_of(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6.0;
    return sum;
}
bool is_closed(const Mesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, back;
    for (const auto& t : mesh.triangles)
        for (std::size_t n = 0; n < 3; ++n) {
            edges.emplace_back(t[n], t[(n + 1) % 3]);
            back.emplace_back(t[(n + 1) % 3], t[n]);
        }
    std::sort(edges.begin(), edges.end());
    std::sort(back.begin(), back.end());
    return edges == back && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

TEST(Bodies, ASeveredBarBecomesTwoWithAllTheBoneThatWasNotCut) {
    Milled milled;
    const double before = bone_volume(milled.body, milled.simulation.exact());
    milled.simulation.look_for_pieces(1e-9 /* 1 mm³ */);
    std::vector<Separation> separations;
    std::uint64_t adopted = 0;
    while (milled.x < 4.0_mm) {
        milled.go();
        milled.simulation.after_tick();
        for (auto& s : milled.simulation.take_separations()) {
            separations.push_back(std::move(s));
            adopted = milled.simulation.ticks();
        }
    }
    milled.simulation.finish();

    ASSERT_EQ(separations.size(), 1u);
    EXPECT_EQ(adopted, separations[0].tick + Simulation::adoption_delay);
    ASSERT_EQ(milled.simulation.bodies().size(), 2u);
    double left = 0.0;
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_TRUE(milled.simulation.committed(b).same_bits(milled.simulation.exact(b))) << "body " << b;
        const double volume = bone_volume(milled.body, milled.simulation.exact(b));
        const Mesh mesh = bone_surface(milled.body, milled.simulation.exact(b));
        EXPECT_TRUE(is_closed(mesh)) << "body " << b;
        EXPECT_NEAR(volume_of(mesh) / volume, 1.0, 0.02 /* marching cubes cut the edges off */) << "body " << b;
        left += volume;
    }
    EXPECT_NEAR((left + milled.simulation.present().removed() + milled.simulation.present().crumb_volume()) / before, 1.0, 1e-3);
    // 14 mm long, cut at y = 2 mm by 1.2 mm: 8.4 mm and 4.4 mm of 9 mm² stay
    EXPECT_NEAR(bone_volume(milled.body, milled.simulation.exact(0)), 8.4 * 9e-9, 0.02 * 8.4 * 9e-9);
    EXPECT_NEAR(bone_volume(milled.body, milled.simulation.exact(1)), 4.4 * 9e-9, 0.02 * 4.4 * 9e-9);
}

TEST(Bodies, TheToolFeelsBothPiecesWhereTheyAre) {
    // Given a severed bar, its end moved away by 3 mm
    Milled milled;
    milled.simulation.look_for_pieces(1e-9);
    while (milled.x < 4.0_mm) {
        milled.go();
        milled.simulation.after_tick();
    }
    ASSERT_EQ(milled.simulation.bodies().size(), 2u);
    const auto felt = [&](double y) {
        const Vec3 point = inverse(milled.simulation.world_from_tool()) * Vec3{0, y, 1.2_mm};
        kerf_surface_point answer;
        milled.simulation.bone().nearest(&point, 1, &answer);
        return answer;
    };
    // When asked 0.3 mm under the bar's upper face, 1 mm from the cut, on both sides of it
    const auto stump = felt(0.4_mm), end = felt(3.6_mm);
    // Then each body answers for itself
    EXPECT_LT(stump.distance, 0.0);
    EXPECT_EQ(stump.body, 0);
    EXPECT_LT(end.distance, 0.0);
    EXPECT_EQ(end.body, 1);
    // and what was moved away is where it went
    milled.simulation.place_body(1, {{0, 3.0_mm, 0}, {1, 0, 0, 0}});
    EXPECT_EQ(felt(3.6_mm).body, -1);
    EXPECT_EQ(felt(6.6_mm).body, 1);
    milled.simulation.show_body(1, false);
    EXPECT_EQ(felt(6.6_mm).body, -1);
}

TEST(Bodies, ACutThroughTwoBodiesAtOnceIsRecordedInEachFrame) {
    Milled milled;
    milled.simulation.look_for_pieces(1e-9);
    while (milled.x < 4.0_mm) {
        milled.go();
        milled.simulation.after_tick();
    }
    ASSERT_EQ(milled.simulation.bodies().size(), 2u);
    // Given the end 1 mm nearer to the stump, 0.2 mm from it, so that one way of the mill takes from both
    milled.simulation.place_body(1, {{0, -1.0_mm, 0}, {1, 0, 0, 0}});
    const double before[2] = {bone_volume(milled.body, milled.simulation.exact(0)), bone_volume(milled.body, milled.simulation.exact(1))};
    int records[2] = {0, 0};
    // When the mill comes back between them
    for (double x = milled.x; x > -3.0_mm; x -= 2.0_um) {
        milled.simulation.tick({test::mill_at(x, 1.5_mm)});
        for (const CutRecord& record : milled.simulation.closed())
            if (record.removes) ++records[record.body];
        milled.simulation.after_tick();
    }
    milled.simulation.finish();
    // Then it took from both
    EXPECT_GT(records[0], 10);
    EXPECT_GT(records[1], 10);
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_LT(bone_volume(milled.body, milled.simulation.exact(b)), before[b] - 0.5e-9) << "body " << b;
        EXPECT_TRUE(milled.simulation.committed(b).same_bits(milled.simulation.exact(b))) << "body " << b;
    }
}

// ---- the worker ---------------------------------------------------------------------------------------------------

struct Ended {
    std::vector<std::uint64_t> hashes;
    std::vector<std::uint64_t> adopted_at;
    std::vector<Pose> way;
};

/// On the clock: the worker is asked as it comes, and is slow now and then. `late`: how slow.
Ended live(int late) {
    Milled milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    Ended ended;
    while (milled.x < 4.0_mm) {
        const TickResult r = milled.go();
        for (const CutRecord& record : milled.simulation.closed())
            EXPECT_TRUE(!record.removes || worker.push(record));
        ended.way.push_back(r.world_from_tool);
        milled.simulation.make_room();
        // However slow this machine is, the worker is never behind for long.
        if (late == 0 || milled.simulation.ticks() % (25 + static_cast<unsigned>(late)) == 0) worker.wait_for_all();
        if (late > 0 && milled.simulation.ticks() % 17 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1 + milled.simulation.ticks() * 7 % static_cast<unsigned>(late)));
        if (Adoption* offer = worker.offered(); offer != nullptr && offer->tick + Simulation::adoption_delay + static_cast<unsigned>(late) <= milled.simulation.ticks()) {
            const bool is_adopted = milled.simulation.adopt(*offer);
            worker.answer(is_adopted);
            if (is_adopted) ended.adopted_at.push_back(milled.simulation.ticks());
        }
    }
    worker.wait_for_all();
    for (std::size_t b = 0; b < worker.bone().count(); ++b) ended.hashes.push_back(worker.bone().cut(b).hash());
    EXPECT_EQ(worker.lost(), 0u);
    return ended;
}

Ended lock_step(const std::vector<std::uint64_t>& adoptions) {
    Milled milled;
    milled.simulation.look_for_pieces(1e-9);
    milled.simulation.replay_adoptions(adoptions);
    Ended ended;
    while (milled.x < 4.0_mm) {
        ended.way.push_back(milled.go().world_from_tool);
        milled.simulation.after_tick();
        for (std::size_t n = 0; n < milled.simulation.take_separations().size(); ++n) ended.adopted_at.push_back(milled.simulation.ticks());
    }
    for (std::size_t b = 0; b < milled.simulation.present().count(); ++b) ended.hashes.push_back(milled.simulation.exact(b).hash());
    return ended;
}

TEST(SurfaceWorker, LiveAndLockStepGiveTheSameBitsForTheSameAdoption) {
    for (const int late : {0, 3, 40}) {
        const Ended on_the_clock = live(late);
        ASSERT_EQ(on_the_clock.adopted_at.size(), 1u) << "late by " << late;
        const Ended replayed = lock_step(on_the_clock.adopted_at);
        EXPECT_EQ(replayed.adopted_at, on_the_clock.adopted_at);
        EXPECT_EQ(replayed.hashes, on_the_clock.hashes) << "late by " << late;
        ASSERT_EQ(replayed.way.size(), on_the_clock.way.size());
        for (std::size_t i = 0; i < replayed.way.size(); ++i) ASSERT_TRUE(replayed.way[i].position == on_the_clock.way[i].position) << "tick " << i << ", late by " << late;
    }
}

TEST(SurfaceWorker, PublishesTheSurfaceOfEachBody) {
    Milled milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    const auto at_first = worker.surface();
    ASSERT_EQ(at_first->patches.size(), 1u);
    milled.simulation.look_for_pieces(1e-9);
    while (milled.x < 4.0_mm) {
        milled.go();
        for (const CutRecord& record : milled.simulation.closed())
            EXPECT_TRUE(!record.removes || worker.push(record));
        milled.simulation.make_room();
        if (milled.simulation.ticks() % 10 == 0) worker.wait_for_all();
        if (Adoption* offer = worker.offered(); offer != nullptr && offer->tick + Simulation::adoption_delay <= milled.simulation.ticks())
            worker.answer(milled.simulation.adopt(*offer));
    }
    worker.wait_for_all();
    const auto at_last = worker.surface();
    ASSERT_EQ(at_last->patches.size(), 2u);
    EXPECT_GT(at_last->version, at_first->version);
    // What was handed out before has not changed, and what there is now is the whole surface
    for (std::size_t body = 0; body < 2; ++body) {
        SurfacePatches whole(milled.body);
        (void)whole.update_all(worker.bone().cut(body));
        for (std::size_t b = 0; b < milled.body.grid().brick_count(); ++b) {
            const auto& mine = at_last->patches[body][b];
            ASSERT_EQ(mine == nullptr, whole.patch(b) == nullptr) << "body " << body << ", brick " << b;
            if (mine != nullptr) {
                ASSERT_TRUE(mine->is_same_as(whole.patch(b)->view())) << "body " << body << ", brick " << b;
            }
        }
    }
}

std::size_t triangles_of(const SurfaceWorker::Surface& surface, std::size_t bricks) {
    std::size_t sum = 0;
    for (const PatchTable& patches : surface.patches)
        for (std::size_t b = 0; b < bricks; ++b)
            if (patches[b] != nullptr) sum += patches[b]->triangles().size();
    return sum;
}

TEST(SurfaceWorker, AReaderOnAThreadOfItsOwnSeesNewSurfacesAndKeepsTheOld) {
    // Given a reader who takes one surface after the other, and keeps the first
    Milled milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    const std::size_t bricks = milled.body.grid().brick_count();
    const auto first = worker.surface();
    const std::size_t at_first = triangles_of(*first, bricks);
    std::atomic<bool> has_seen_it_change{false};
    std::thread reader([&] {
        std::uint64_t last = first->version;
        while (!has_seen_it_change) {
            const auto now = worker.surface();
            EXPECT_GE(now->version, last);
            last = now->version;
            has_seen_it_change = triangles_of(*now, bricks) != at_first;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    });

    // When bone is milled, and nobody waits for the worker
    while (milled.x < 0.0_mm) {
        milled.go();
        for (const CutRecord& record : milled.simulation.closed())
            if (record.removes) (void)worker.push(record);
        milled.simulation.make_room();
    }

    // Then the reader comes to see it, and what it kept has not changed
    reader.join();
    EXPECT_EQ(triangles_of(*first, bricks), at_first);
}

TEST(SurfaceWorker, AdoptingWhatItMadeNeitherAllocatesNorWaits) {
    Milled milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    bool has_adopted = false;
    while (milled.x < 4.0_mm) {
        const test::Forbidden before = test::forbidden_here();
        milled.go();
        for (const CutRecord& record : milled.simulation.closed())
            if (record.removes) (void)worker.push(record);
        if (Adoption* offer = worker.offered(); offer != nullptr && offer->tick + Simulation::adoption_delay <= milled.simulation.ticks()) {
            const bool is_adopted = milled.simulation.adopt(*offer);
            worker.answer(is_adopted);
            has_adopted = has_adopted || is_adopted;
        }
        EXPECT_EQ(test::forbidden_here(), before) << "tick " << milled.simulation.ticks();
        milled.simulation.make_room();
        if (milled.simulation.ticks() % 10 == 0) worker.wait_for_all();
    }
    EXPECT_TRUE(has_adopted);
}

}  // namespace
}  // namespace kerf
