// SPDX-License-Identifier: Apache-2.0
#include "session/first_difference.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "session/recorder.h"
#include "tests/session/synthetic_run.h"
#include "tests/support/temporary_folder.h"

namespace kerf::session {
namespace {

using test::TemporaryFolder;

/// Writes a session of 600 ticks, whose rows and events `change` may alter first.
std::string record(const std::string& path,
                   const std::function<void(std::vector<TickRow>&, std::vector<EventRow>&)>& change = {}) {
    std::vector<TickRow> rows = test::synthetic_ticks(600);
    std::vector<EventRow> events{{100, 0.1, "first.touch", "somewhere"}, {500, 0.5, "breakthrough", ""}};
    if (change) change(rows, events);
    SessionHeader header;
    header.signals = test::synthetic_summary().signals;
    auto created = Recorder::create(path, header);
    if (created.recorder == nullptr) return created.error;
    std::size_t next = 0;
    for (const TickRow& row : rows) {
        for (; next < events.size() && events[next].tick <= row.tick; ++next)
            created.recorder->push_event(events[next]);
        created.recorder->push(row);
        static_cast<void>(created.recorder->wait_for_capacity());
    }
    return created.recorder->finish(test::synthetic_summary());
}

struct TwoSessions : testing::Test {
    TemporaryFolder folder;
    const std::string a = folder / "a.db", b = folder / "b.db";
    std::string error;

    std::optional<FirstDifference> compared(
        const std::function<void(std::vector<TickRow>&, std::vector<EventRow>&)>& change) {
        EXPECT_EQ(record(a), "");
        EXPECT_EQ(record(b, change), "");
        auto first = first_difference(a, b, error);
        EXPECT_EQ(error, "");
        return first;
    }
};

TEST_F(TwoSessions, OfTheSameValuesDoNotDiffer) {
    EXPECT_FALSE(compared([](auto& rows, auto& events) {
        events[0].detail = "elsewhere";  // not hashed
        rows[300].signals[0] += 1.0;
        rows[400].limited[0] += 1.0;
    }));
}

TEST_F(TwoSessions, DifferFromTheFirstTickOn) {
    const auto first = compared([](auto& rows, auto& /*events*/) {
        rows[413].coupled[1] = 7.0;
        rows[412].modelled[2] += 0.5;
        rows[300].modelled[2] *= 1.0 + 1e-12;  // below the recorded precision
    });
    ASSERT_TRUE(first);
    EXPECT_EQ(first->tick, 412u);
    EXPECT_DOUBLE_EQ(first->time, 0.412);
    EXPECT_EQ(first->step, 0);
    EXPECT_EQ(first->what, "the wrench of the bone");
}

TEST_F(TwoSessions, MayBothHaveNoNumber) {
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(record(a, [&](auto& rows, auto&) { rows[9].coupled[0] = nan; }), "");
    EXPECT_EQ(record(b, [&](auto& rows, auto&) { rows[9].coupled[0] = nan; }), "");
    EXPECT_FALSE(first_difference(a, b, error));
    EXPECT_EQ(error, "");
}

TEST_F(TwoSessions, DifferInAnEventBeforeATick) {
    const auto first = compared([](auto& rows, auto& events) {
        events[0].tick = 90;
        rows[95].world_from_tool.position.x += 1e-3;
    });
    ASSERT_TRUE(first);
    EXPECT_EQ(first->tick, 90u);
    EXPECT_EQ(first->step, 0);
    EXPECT_EQ(first->what, "the event `first.touch`");
}

TEST_F(TwoSessions, DifferInTheirEnds) {
    const auto first = compared([](auto& rows, auto& /*events*/) { rows.resize(550); });
    ASSERT_TRUE(first);
    EXPECT_EQ(first->tick, 550u);
    EXPECT_EQ(first->what, "the end of the run, which is earlier");
}

TEST_F(TwoSessions, AreNamedIfOneCannotBeRead) {
    EXPECT_EQ(record(a), "");
    EXPECT_FALSE(first_difference(a, folder / "none.db", error));
    EXPECT_NE(error.find("none.db"), std::string::npos) << error;
}

}  // namespace
}  // namespace kerf::session
