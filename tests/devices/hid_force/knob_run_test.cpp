// SPDX-License-Identifier: Apache-2.0
// A hand that leads a screw by a Touch and turns it by a knob: through both drivers and the stand-ins of both devices.
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "tests/devices/hid_force/knob_stand_in.h"
#include "tests/devices/openhaptics/openhaptics_stand_in.h"
#include "tests/run/seat_a_screw.h"
#include "tests/run/stylus_and_knob.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

/// Keeps the rows of the ticks.
struct Rows final : RunObserver {
    void on_tick(const session::TickRow& row) override { rows.push_back(row); }
    std::vector<session::TickRow> rows{};
};

TEST(KnobRun, TurnsAScrewThatAStylusLeads) {
    const test::TemporaryFolder folder;
    const std::string procedure = write_seat_a_screw(folder.path(), "by: 5 turns, speed: 60 rpm", "touch");
    openhaptics::OpenHapticsStandIn stylus;
    hid_force::EmulatedKnob knob;
    StylusAndKnob both(stylus, knob);
    Rows rows;
    const LiveAndAgain runs = run_live_at(procedure, {"time_limit=12 s"}, both, openhaptics::OpenHapticsStandIn::open(),
                                          folder / "led", knob.open(), &rows);
    ASSERT_EQ(runs.live.error, "");
    EXPECT_EQ(runs.again.summary.hash, runs.live.summary.hash) << "the replay has the same bits";
    EXPECT_NEAR(turned_by(rows.rows, &session::TickRow::world_from_tool) / (2.0 * std::numbers::pi), 5.0, 0.1);
    EXPECT_LT(knob.largest_torque(), -0.01) << "the bone resists the turn";
    EXPECT_EQ(knob.fault(), "");
}

}  // namespace
}  // namespace kerf::run
