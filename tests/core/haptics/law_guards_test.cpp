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

#include "core/haptics/law/call_times.h"
#include "core/haptics/law/channel.h"
#include "core/haptics/loop/device_record.h"
#include "core/haptics/scene/simulation.h"
#include "kerf/plugin.hpp"
#include "tests/support/block.h"
#include "tests/support/rig.h"

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

struct Bar {
    static constexpr auto about() { return describe("bar", "A pointed bar."); }
    [[nodiscard]] Outline outline() const {
        return revolution({{0.0, 0.0}, {-1.0_mm, 1.0_mm}})
            .cuts()
            .to(-1.5_mm, 1.5_mm)
            .to(-40.0_mm, 1.5_mm)
            .gripped_at(-60.0_mm);
    }
};
/// A law that resists at its shaft if it has a stiffness, and nowhere else.
struct Shaft {
    double stiffness;

    static constexpr auto about() {
        return describe("shaft", "Contact of the shaft.",
                        param(&Shaft::stiffness, {.id = "stiffness",
                                                  .help = "Of bone.",
                                                  .unit = unit::N_per_mm,
                                                  .min = 0.0,
                                                  .max = 1000.0_N_per_mm,
                                                  .def = 0.0,
                                                  .source = "the test's"}));
    }
    void resist(const Held<Bar>&, const BoneQuery& bone, Channels& channels) const noexcept {
        if (stiffness == 0.0) return;
        const Vec3 points[] = {
            {1.5_mm, 0, -8.0_mm}, {-1.5_mm, 0, -8.0_mm}, {0, 1.5_mm, -8.0_mm}, {0, -1.5_mm, -8.0_mm}};
        kerf_surface_point at[std::size(points)];
        bone.nearest(points, at);
        for (std::uint32_t i = 0; i < std::size(points); ++i)
            if (at[i].body >= 0 && at[i].distance <= 0.2_mm)
                channels.contact({.id = i,
                                  .at = points[i],
                                  .along = normalized(Vec3{points[i].x, points[i].y, 0}),
                                  .stiffness = stiffness,
                                  .depth = -at[i].distance});
    }
};

ToolSetup shaft(double stiffness) {
    using Components = PluginTables<Bar, Shaft>;
    return {.tool = &Components::components[0],
            .force = &Components::components[1],
            .tool_parameters = {},
            .force_parameters = {stiffness},
            .drives = {},
            .bound = {}};
}

/// The events while a bar beside a slab, 5.5 to 10.5 mm behind its tip, is pushed 3 mm into its side and drawn back,
/// twice.
std::vector<std::string> pushed_sideways(double stiffness, double spacing) {
    const auto at = [](double x) { return test::pointing({x, 0, -12.0_mm}, {0, 0, -1}); };
    const CouplingGains gains = gains_for(*find_device("premium-1.5-6dof"), 1.0);
    test::Rig simulation(test::block({0.0, -6.0_mm, -6.5_mm}, {12.0_mm, 6.0_mm, -1.5_mm}, spacing), shaft(stiffness),
                         at(-3.0_mm), gains);
    std::vector<std::string> events;
    const auto go = [&](double from, double to) {
        for (int i = 1; i <= 300; ++i) {
            const TickResult result = simulation.tick({at(from + (to - from) * i / 300)});
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
