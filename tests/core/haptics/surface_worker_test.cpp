// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/scene/surface_worker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/loop_guard.h"
#include "tests/support/milled_bar.h"

namespace kerf {
namespace {

using namespace literals;
using test::Milled;

/// The loop alone.
struct MilledLoop {
    Body body = test::bar(0.2e-3);
    ToolSetup setup = test::mill();
    ToolOutline outline = test::outline(setup);
    HapticLoop loop{body, setup, outline, gains_for(*find_device("premium-1.5-6dof"), 0.1), test::mill_at(-3.0e-3)};
    double x = -3.0e-3;

    /// One tick of the hand on its way along x, 2 µm.
    TickResult go(double y = 2.0e-3) {
        x += 2e-6;
        return loop.tick({test::mill_at(x, y)});
    }
};

/// All that is handed out is what a surface made anew would be.
void expect_whole_surface(SurfaceWorker& worker, const Body& body, std::size_t bodies) {
    const auto surface = worker.surface();
    ASSERT_EQ(surface->patches.size(), bodies);
    for (std::size_t n = 0; n < bodies; ++n) {
        SurfacePatches whole(body);
        (void)whole.update_all(worker.bone().cut(n));
        for (std::size_t b = 0; b < body.grid().brick_count(); ++b) {
            const auto& mine = surface->patches[n][b];
            ASSERT_EQ(mine == nullptr, whole.patch(b) == nullptr) << "body " << n << ", brick " << b;
            if (mine != nullptr) {
                ASSERT_TRUE(mine->is_same_as(whole.patch(b)->view())) << "body " << n << ", brick " << b;
            }
        }
    }
}

/// A way of the hand, and what it asks for between its ticks.
struct Script {
    std::vector<Pose> way;
    std::vector<std::pair<std::size_t, HistoryChange>> turns;  ///< before which tick

    Vec3 at{-3.0_mm, 2.0_mm, 6.0_mm};                             ///< where the mill begins
    static constexpr double in_bone = 5.0_um, in_air = 100.0_um;  // a tick

    void go_to(Vec3 to, double step) {
        const Vec3 from = at;
        const int ticks = std::max(1, static_cast<int>(length(to - from) / step));
        for (int i = 1; i <= ticks; ++i)
            way.push_back({at = from + (static_cast<double>(i) / ticks) * (to - from), {1, 0, 0, 0}});
    }
    void wait(int ticks) { way.insert(way.end(), static_cast<std::size_t>(ticks), {at, {1, 0, 0, 0}}); }
    /// Around the bar and through it.
    void sever(double y) {
        const double aside = at.x < 0.0 ? -12.0_mm : 12.0_mm;
        for (const Vec3 to : {Vec3{aside, at.y, 6.0_mm}, Vec3{aside, -20.0_mm, 6.0_mm},
                              Vec3{-12.0_mm, -20.0_mm, 6.0_mm}, Vec3{-4.0_mm, y, 6.0_mm}})
            go_to(to, in_air);
        go_to({4.0_mm, y, 6.0_mm}, in_bone);
        wait(100);
    }
    void turn(HistoryChange turn) {
        go_to({12.0_mm, at.y, 6.0_mm}, in_air);
        turns.emplace_back(way.size(), turn);
        wait(200);
    }
};

/// Twice through the bar; the cuts are taken back and done again; then another.
Script changes_of_mind() {
    Script script;
    script.sever(2.0_mm);
    script.turn(HistoryChange::undo);
    script.turn(HistoryChange::redo);
    script.sever(-3.0_mm);
    script.turn(HistoryChange::undo);
    script.turn(HistoryChange::undo);
    script.turn(HistoryChange::redo);
    script.sever(-3.5_mm);
    return script;
}

struct Ended {
    std::vector<std::uint64_t> hashes, committed;
    std::vector<std::uint64_t> adopted_at;
    std::vector<std::pair<std::uint64_t, HistoryChange>> turned_at;
    std::vector<std::size_t> bodies;
    std::vector<Pose> way;

    void add(const auto& simulation, const PresentBone& bone) {
        for (std::size_t b = 0; b < bone.count(); ++b) hashes.push_back(bone.cut(b).hash());
        for (std::size_t b = 0; b < simulation.bodies().size(); ++b)
            committed.push_back(simulation.committed(b).hash());
    }
};

/// On the clock: the worker is asked as it comes, and is slow now and then. `late`: how slow.
Ended live(const Script& script, unsigned late) {
    MilledLoop milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    Ended ended;
    auto next_turn = script.turns.begin();
    for (std::size_t i = 0; i < script.way.size(); ++i) {
        if (next_turn != script.turns.end() && next_turn->first == i) {
            EXPECT_TRUE(worker.request(next_turn++->second));
        }
        ended.way.push_back(milled.loop.tick({script.way[i]}).world_from_tool);
        const std::uint64_t ticks = milled.loop.ticks();
        // However slow this machine is, the worker is never behind for long.
        if (late == 0 || ticks % (25 + late % 100) == 0) worker.wait_for_all();
        if (late > 0 && ticks % 97 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1 + ticks * 7 % 10));
        const SurfaceWorker::TakenOver taken = worker.exchange(milled.loop, Simulation::adoption_delay + late);
        if (taken.separation) ended.adopted_at.push_back(ticks);
        if (taken.turn) ended.turned_at.emplace_back(ticks, *taken.turn);
        EXPECT_FALSE(taken.refused_change) << "tick " << ticks;
        milled.loop.make_room();
        ended.bodies.push_back(milled.loop.bodies().size());
    }
    worker.wait_for_all();
    ended.add(milled.loop, worker.bone());
    EXPECT_EQ(worker.lost(), 0u);
    return ended;
}

Ended lock_step(const Script& script, const Ended& recorded) {
    Milled milled;
    milled.simulation.find_pieces(1e-9);
    milled.simulation.replay_adoptions(recorded.adopted_at);
    Ended ended;
    auto next_turn = recorded.turned_at.begin();
    for (const Pose& hand : script.way) {
        ended.way.push_back(milled.simulation.tick({hand}).world_from_tool);
        const std::uint64_t ticks = milled.simulation.ticks();
        for (std::size_t n = milled.simulation.take_separations().size(); n > 0; --n) ended.adopted_at.push_back(ticks);
        for (; next_turn != recorded.turned_at.end() && next_turn->first == ticks; ++next_turn) {
            EXPECT_EQ(next_turn->second == HistoryChange::undo ? milled.simulation.undo() : milled.simulation.redo(),
                      "");
            ended.turned_at.push_back(*next_turn);
        }
        ended.bodies.push_back(milled.simulation.bodies().size());
    }
    ended.add(milled.simulation, milled.simulation.present());
    return ended;
}

/// Both end in the same bits, and have been the same on the way.
void compare(const Ended& on_the_clock, const Ended& replayed) {
    EXPECT_EQ(replayed.adopted_at, on_the_clock.adopted_at);
    EXPECT_EQ(replayed.turned_at, on_the_clock.turned_at);
    EXPECT_EQ(replayed.hashes, on_the_clock.hashes);
    EXPECT_EQ(replayed.committed, on_the_clock.committed);
    EXPECT_EQ(replayed.bodies, on_the_clock.bodies);
    ASSERT_EQ(replayed.way.size(), on_the_clock.way.size());
    for (std::size_t i = 0; i < replayed.way.size(); ++i)
        ASSERT_TRUE(replayed.way[i].position == on_the_clock.way[i].position) << "tick " << i;
}

TEST(SurfaceWorker, LiveAndLockStepGiveTheSameBitsForTheSameAdoption) {
    Script script;
    script.sever(2.0_mm);
    script.wait(200);
    for (const unsigned late : {0u, 3u, 40u}) {
        SCOPED_TRACE("late by " + std::to_string(late));
        const Ended on_the_clock = live(script, late);
        ASSERT_EQ(on_the_clock.adopted_at.size(), 1u);
        compare(on_the_clock, lock_step(script, on_the_clock));
    }
}

TEST(SurfaceWorker, HandsOverUndoAndRedoWithTheBitsOfLockStep) {
    const Script script = changes_of_mind();
    for (const unsigned late : {0u, 40u}) {
        SCOPED_TRACE("late by " + std::to_string(late));
        const Ended on_the_clock = live(script, late);
        ASSERT_EQ(on_the_clock.turned_at.size(), script.turns.size());
        EXPECT_EQ(on_the_clock.adopted_at.size(), 3u);
        EXPECT_EQ(on_the_clock.bodies.back(), 3u);
        compare(on_the_clock, lock_step(script, on_the_clock));
    }
}

TEST(SurfaceWorker, UndoOfACutWhosePiecesWereNotYetAdopted) {
    // Given a loop that would take the pieces over minutes after they came apart
    const Script script = changes_of_mind();
    const Ended on_the_clock = live(script, 100000);
    EXPECT_EQ(on_the_clock.turned_at.size(), script.turns.size());
    EXPECT_TRUE(on_the_clock.adopted_at.empty());
    compare(on_the_clock, lock_step(script, on_the_clock));
}

TEST(SurfaceWorker, UndoBringsBackTheUncutBoneAndItsSurface) {
    Script script;
    script.sever(2.0_mm);
    script.go_to({12.0_mm, 2.0_mm, 6.0_mm}, Script::in_air);
    MilledLoop milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    const auto step = [&](const Pose& hand) {
        milled.loop.tick({hand});
        worker.wait_for_all();
        const auto taken = worker.exchange(milled.loop);
        milled.loop.make_room();
        return taken;
    };
    std::optional<CutField> before;
    for (const Pose& hand : script.way) {
        step(hand);
        if (hand.position.x < -11.9_mm && !before) before = worker.bone().cut();
    }
    const CutField& uncut =
        before.value();  // the mill began so near that it changed distances in the air, and that is no cut
    ASSERT_EQ(milled.loop.bodies().size(), 2u);
    ASSERT_EQ(worker.surface()->patches.size(), 2u);

    ASSERT_TRUE(worker.request(HistoryChange::undo));
    EXPECT_FALSE(worker.request(HistoryChange::undo));  // one at a time
    step(script.way.back());
    EXPECT_FALSE(worker.request(HistoryChange::undo));
    EXPECT_EQ(step(script.way.back()).turn, HistoryChange::undo);
    worker.wait_for_all();
    EXPECT_EQ(milled.loop.bodies().size(), 1u);
    EXPECT_TRUE(milled.loop.committed().same_bits(uncut));
    EXPECT_TRUE(worker.bone().cut().same_bits(uncut));
    EXPECT_EQ(worker.bone().removed(), 0.0);
    expect_whole_surface(worker, milled.body, 1);

    // There is nothing before that
    ASSERT_TRUE(worker.request(HistoryChange::undo));
    step(script.way.back());
    EXPECT_EQ(step(script.way.back()).refused_change, HistoryChange::undo);
    ASSERT_TRUE(worker.request(HistoryChange::redo));
    step(script.way.back());
    EXPECT_EQ(step(script.way.back()).turn, HistoryChange::redo);
    worker.wait_for_all();
    EXPECT_EQ(milled.loop.bodies().size(), 2u);
    expect_whole_surface(worker, milled.body, 2);
}

TEST(SurfaceWorker, UndoIsRefusedWhileTheToolIsInBone) {
    Script script;
    script.sever(2.0_mm);
    MilledLoop milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    std::optional<HistoryChange> refused, turned;
    for (std::size_t i = 0; i + 800 < script.way.size(); ++i) {
        if (i + 1000 == script.way.size()) {
            ASSERT_TRUE(worker.request(HistoryChange::undo));
        }
        milled.loop.tick({script.way[i]});
        if (i + 900 == script.way.size()) worker.wait_for_all();
        const auto taken = worker.exchange(milled.loop);
        if (taken.refused_change) refused = taken.refused_change;
        if (taken.turn) turned = taken.turn;
        milled.loop.make_room();
    }
    EXPECT_EQ(refused, HistoryChange::undo);
    EXPECT_FALSE(turned);
    worker.wait_for_all();
    EXPECT_GT(worker.bone().removed(), 0.0);
}

TEST(SurfaceWorker, TakingACutBackNeitherAllocatesNorWaits) {
    const Script script = changes_of_mind();
    MilledLoop milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    auto next_turn = script.turns.begin();
    std::size_t turned = 0;
    for (std::size_t i = 0; i < script.way.size(); ++i) {
        const test::Forbidden before = test::forbidden_here();
        if (next_turn != script.turns.end() && next_turn->first == i) (void)worker.request(next_turn++->second);
        milled.loop.tick({script.way[i]});
        turned += worker.exchange(milled.loop).turn ? 1 : 0;
        EXPECT_EQ(test::forbidden_here(), before) << "tick " << i;
        milled.loop.make_room();
        if (i % 10 == 0) worker.wait_for_all();
    }
    EXPECT_EQ(turned, script.turns.size());
}

TEST(SurfaceWorker, PublishesTheSurfaceOfEachBody) {
    MilledLoop milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    const auto at_first = worker.surface();
    ASSERT_EQ(at_first->patches.size(), 1u);
    while (milled.x < 4.0_mm) {
        milled.go();
        milled.loop.make_room();
        if (milled.loop.ticks() % 10 == 0) worker.wait_for_all();
        (void)worker.exchange(milled.loop);
    }
    worker.wait_for_all();
    EXPECT_GT(worker.surface()->version, at_first->version);
    expect_whole_surface(worker, milled.body, 2);
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
    MilledLoop milled;
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
        (void)worker.exchange(milled.loop);
        milled.loop.make_room();
    }

    // Then the reader comes to see it, and what it kept has not changed
    reader.join();
    EXPECT_EQ(triangles_of(*first, bricks), at_first);
}

TEST(SurfaceWorker, AdoptingWhatItMadeNeitherAllocatesNorWaits) {
    MilledLoop milled;
    SurfaceWorker worker(milled.body, {&milled.outline.cutting}, {.crumb = 1e-9});
    bool has_adopted = false;
    while (milled.x < 4.0_mm) {
        const test::Forbidden before = test::forbidden_here();
        milled.go();
        has_adopted = worker.exchange(milled.loop).separation || has_adopted;
        EXPECT_EQ(test::forbidden_here(), before) << "tick " << milled.loop.ticks();
        milled.loop.make_room();
        if (milled.loop.ticks() % 10 == 0) worker.wait_for_all();
    }
    EXPECT_TRUE(has_adopted);
}

}  // namespace
}  // namespace kerf
