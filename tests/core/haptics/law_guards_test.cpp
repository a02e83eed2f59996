// SPDX-License-Identifier: Apache-2.0
// What the host notices of a law: a number it cannot solve with, calls that are too slow, a part of the tool that
// nothing resists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "core/haptics/call_times.h"
#include "core/haptics/channel.h"
#include "core/haptics/device_record.h"
#include "core/haptics/simulation.h"
#include "kerf/force.hpp"
#include "tests/support/block.h"
#include "tests/support/made_outline.h"

namespace kerf {
namespace {

using namespace literals;

kerf_channel sound_channel() {
    kerf_channel c{};
    c.kind = KERF_CUT;
    c.d[2] = 1.0;
    c.w = 1e-5;
    return c;
}

TEST(ChannelFault, NamesTheFieldThatIsUnsound) {
    EXPECT_EQ(fault_of(sound_channel()).field, nullptr);
    const double nan = std::nan("");
    struct Case {
        const char* field;
        void (*spoil)(kerf_channel& c, double nan);
    };
    for (const Case& one : {Case{"d[4]", [](kerf_channel&c, double v) { c.d[4] = v; }},
                            {"follow[1]", [](kerf_channel&c, double v) { c.follow[1] = v; }},
                            {"tau", [](kerf_channel&c, double v) { c.tau = v; }},
                            {"eta", [](kerf_channel&c, double) { c.eta = -1.0; }},
                            {"gap", [](kerf_channel&c, double) { c.gap = HUGE_VAL; }},
                            {"k", [](kerf_channel&c, double) { c.k = -1.0; }},
                            {"b", [](kerf_channel&c, double v) { c.b = v; }},
                            {"delta", [](kerf_channel&c, double v) { c.delta = v; }},
                            {"w", [](kerf_channel&c, double) { c.w = 0.0; }},
                            {"d", [](kerf_channel&c, double) { c.d[2] = 0.0; }},
                            {"kind", [](kerf_channel&c, double) { c.kind = 4; }}}) {
        kerf_channel c = sound_channel();
        one.spoil(c, nan);
        EXPECT_STREQ(fault_of(c).field, one.field);
        EXPECT_FALSE(is_sound(c)) << one.field;
    }
}

TEST(CallTimes, KeepDurationsWithinSixPercent) {
    for (const std::uint64_t counts : {0ull, 3ull, 15ull, 16ull, 17ull, 1000ull, 123456789ull, 1ull << 62}) {
        CallTimes times;
        times.add(counts);
        const double end = static_cast<double>(times.within(1.0)), is = static_cast<double>(counts);
        EXPECT_EQ(times.within(1.0), counts) << "no longer than the longest";
        times.add(2 * counts + 1);
        EXPECT_GE(static_cast<double>(times.within(0.5)), is);
        EXPECT_LE(static_cast<double>(times.within(0.5)), 1.0625 * is + 1.0) << end;
        EXPECT_EQ(times.longer_than(counts), 1u);
    }
}

TEST(CallTimes, ReportABudgetWhenOneInAHundredIsOver) {
    const ClockScale scale;
    const auto counts = [&](double seconds) { return static_cast<std::uint64_t>(seconds / scale.seconds_per_count()); };
    while (counts(1e-3) < 1000) (void)clock_count();  // until the scale is known
    kerf_force force{};
    force.budget_ns = 20000;
    kerf_component law{};
    law.id = "burring";
    law.force = &force;
    CallTimes times;
    for (int i = 0; i < 9900; ++i) times.add(counts(5e-6));
    for (int i = 0; i < 100; ++i) times.add(counts(3e-3));
    EXPECT_EQ(over_budget(times, law, scale), "");
    for (int i = 0; i < 100; ++i) times.add(counts(3e-3));
    EXPECT_EQ(over_budget(times, law, scale)
                  .find("`burring`: 200 of 10100 calls of `resist` took longer than its budget "
                        "of 20 us: 99.9 % within "),
              0u)
        << over_budget(times, law, scale);
    force.budget_ns = 0;
    EXPECT_EQ(over_budget(times, law, scale), "") << "it declares none";
}

/// A law that resists at its shaft if it is told so, and nowhere else.
struct Shaft {
    struct State {};
    enum : std::size_t {
        stiffness,
        force_parameter_count,
        tool_parameter_count = 0,
        drive_count = 0,
        signal_count = 0
    };
    static void resist(const Tick& tick, const BoneQuery& bone, const State&, Channels& channels) noexcept {
        if (tick.force[stiffness] == 0.0) return;
        const Vec3 points[] = {
            {1.5_mm, 0, -8.0_mm}, {-1.5_mm, 0, -8.0_mm}, {0, 1.5_mm, -8.0_mm}, {0, -1.5_mm, -8.0_mm}};
        kerf_surface_point at[std::size(points)];
        bone.nearest(points, at);
        for (std::uint32_t i = 0; i < std::size(points); ++i) {
            if (at[i].body < 0 || at[i].distance > 0.2_mm) continue;
            kerf_channel* c = channels.add(KERF_CONTACT, i);
            const Vec6 d = rate_at(points[i], normalized(Vec3{points[i].x, points[i].y, 0}));
            std::copy(d.begin(), d.end(), c->d);
            c->k = tick.force[stiffness];
            c->delta = -at[i].distance;
        }
    }
    static void commit(const Tick&, const BoneQuery&, const Advance&, State&, std::span<double>, Actions&) noexcept {}
};

ToolSetup shaft(double stiffness) {
    static const kerf_tool tool = [] {
        kerf_tool t{};
        t.size = sizeof t;
        t.shape = [](const double*, kerf_tool_shape* out) -> kerf_status {
            const kerf_profile_point points[] = {{0.0, 0.0}, {-1.0_mm, 1.0_mm}, {-1.5_mm, 1.5_mm}, {-40.0_mm, 1.5_mm}};
            std::copy(std::begin(points), std::end(points), out->profile);
            out->profile_count = 4;
            out->cutting_count = 2;
            out->grip_z = -60.0_mm;
            return KERF_OK;
        };
        return t;
    }();
    static const kerf_force force = [] {
        using Table = ForceTable<Shaft>;
        kerf_force f{};
        f.size = sizeof f;
        f.state_size = sizeof(Shaft::State);
        f.state_align = alignof(Shaft::State);
        f.begin = &Table::begin;
        f.resist = &Table::resist;
        f.commit = &Table::commit;
        return f;
    }();
    static kerf_component components[2]{};
    components[0].id = "bar";
    components[0].tool = &tool;
    components[1].id = "shaft";
    components[1].force = &force;
    return {&components[0], &components[1], {}, {stiffness}, {}};
}

/// The events while a bar beside a slab, 5.5 to 10.5 mm behind its tip, is pushed 3 mm into its side and drawn back,
/// twice.
std::vector<std::string> pushed_sideways(double stiffness, double spacing) {
    const Body body = test::block({0.0, -6.0_mm, -6.5_mm}, {12.0_mm, 6.0_mm, -1.5_mm}, spacing);
    const ToolSetup setup = shaft(stiffness);
    const auto at = [](double x) { return test::pointing({x, 0, -12.0_mm}, {0, 0, -1}); };
    const CouplingGains gains = gains_for(*find_device("premium-1.5-6dof"), 1.0);
    Simulation simulation(body, setup, test::outline(setup), gains, at(-3.0_mm));
    std::vector<std::string> events;
    const auto go = [&](double from, double to) {
        for (int i = 1; i <= 300; ++i) {
            const TickResult result = simulation.tick({at(from + (to - from) * i / 300)});
            simulation.after_tick();
            for (std::size_t e = 0; e < result.event_count; ++e) events.emplace_back(result.events[e]);
        }
    };
    for (int stroke = 0; stroke < 2; ++stroke) {
        go(-3.0_mm, 1.5_mm);
        go(1.5_mm, -3.0_mm);
    }
    return events;
}

TEST(Unresisted, IsReportedOnceEachTimeAToolGoesThroughBone) {
    for (const double spacing : {0.25_mm, 0.5_mm})
        EXPECT_EQ(pushed_sideways(0.0, spacing), (std::vector<std::string>{"haptics.unresisted", "haptics.unresisted"}))
            << spacing;
}

TEST(Unresisted, IsNotReportedWhereTheLawResists) {
    EXPECT_EQ(pushed_sideways(1.0_N_per_mm, 0.25_mm), std::vector<std::string>{})
        << "however deep it gives: the channel is there";
}

}  // namespace
}  // namespace kerf
