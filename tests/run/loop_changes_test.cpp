// SPDX-License-Identifier: Apache-2.0
// What a run posts to a loop on the clock, and posts again after the loop has refused it.
#include "run/loop_changes.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>

#include "run/live/loop_link.h"
#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf::run {
namespace {

using namespace literals;

/// A run that follows a loop, of which a test plays the part.
struct Followed {
    ToolSetup setup = test::probe(20.0_N_per_mm);
    test::Rig simulation{test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.5_mm), setup,
                         test::at_depth(-20.0_mm)};
    std::unique_ptr<LoopLink> link = std::make_unique<LoopLink>();
    LoopChanges changes{simulation};

    Followed() { changes.begin_following(*link); }
    /// Returns the change that the loop finds, and gives it back; null: none is posted.
    const LoopChange* take() {
        PostedChange* posted = link->change.posted();
        if (posted == nullptr) return nullptr;
        last_ = std::move(posted->change);
        link->change.give_back();
        return &last_;
    }

private:
    LoopChange last_;
};

const Guide sleeve{.mouth = {0, 0, 1.0_mm}, .along = {0, 0, -1}, .length = 20.0_mm, .bore_radius = 2.0_mm};

TEST(LoopChanges, PostsARefusedChangeAgain) {
    for (const bool is_refused : {true, false}) {
        Followed run;
        run.changes.lead(sleeve);
        run.changes.remove_held();
        run.changes.take_tool(0, 3.0_mm);
        run.changes.post(0);
        const LoopChange* posted = run.take();
        ASSERT_TRUE(posted);
        EXPECT_TRUE(posted->guide && *posted->guide == sleeve);
        EXPECT_TRUE(posted->removes_held);
        EXPECT_EQ(posted->tool, 0u);

        EXPECT_EQ(run.changes.make(is_refused).is_refused, is_refused);
        EXPECT_EQ(run.changes.awaits_tool(), is_refused);
        run.changes.post(0);
        posted = run.take();
        ASSERT_EQ(posted != nullptr, is_refused);
        if (!is_refused) continue;
        EXPECT_TRUE(posted->guide && *posted->guide == sleeve);
        EXPECT_TRUE(posted->removes_held);
        EXPECT_EQ(posted->tool, 0u);
        EXPECT_EQ(posted->back, 3.0_mm);
    }
}

TEST(LoopChanges, PrefersWhatWasDecidedAfterARefusedChange) {
    Followed run;
    run.changes.lead(sleeve);
    run.changes.take_tool(0, 3.0_mm);
    run.changes.post(0);
    ASSERT_TRUE(run.take());
    run.changes.lead(std::nullopt);
    run.changes.take_tool(0, 5.0_mm);
    EXPECT_TRUE(run.changes.make(true).is_refused);
    run.changes.post(0);
    const LoopChange* posted = run.take();
    ASSERT_TRUE(posted);
    EXPECT_TRUE(posted->guide && !*posted->guide) << "no sleeve";
    EXPECT_EQ(posted->back, 5.0_mm);
    EXPECT_FALSE(posted->removes_held);
}

}  // namespace
}  // namespace kerf::run
