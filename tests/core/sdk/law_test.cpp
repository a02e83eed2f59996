// SPDX-License-Identifier: Apache-2.0
// From plain structs to the C tables and back.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "kerf/plugin.hpp"

namespace kerf {
namespace {

using namespace literals;

struct Rod {
    double diameter, length, speed;

    static constexpr auto about() {
        return describe("rod", "A rod.",
                        param(&Rod::diameter, {.id = "diameter",
                                               .help = "Across.",
                                               .unit = unit::mm,
                                               .min = 1_mm,
                                               .max = 9_mm,
                                               .def = 4_mm,
                                               .source = "test"}),
                        param(&Rod::length, {.id = "length",
                                             .help = "Along.",
                                             .unit = unit::mm,
                                             .min = 1_mm,
                                             .max = 90_mm,
                                             .def = 50_mm,
                                             .source = "test"}),
                        drive(&Rod::speed, {.id = "speed",
                                            .help = "Turns.",
                                            .unit = unit::rpm,
                                            .min = 0.0,
                                            .max = 6000_rpm,
                                            .def = 60_rpm,
                                            .least = 6_rpm}));
    }
    [[nodiscard]] Outline outline() const {
        return revolution({{0, 0}, {-diameter, diameter / 2}})
            .cuts()
            .to(-length, diameter / 2)
            .gripped_at(-length - 1_mm);
    }
};
struct Bar {
    double width;
    std::array<double, 2> edge;

    static constexpr auto about() {
        return describe(
            "bar", "A bar.",
            param(&Bar::width, {.id = "width",
                                .help = "Across.",
                                .unit = unit::mm,
                                .min = 1_mm,
                                .max = 9_mm,
                                .def = 2_mm,
                                .source = "test"}),
            param(+[](Bar& bar) -> double& { return bar.edge[1]; },
                  {.id = "edge_2", .help = "The second edge.", .min = 0.0, .max = 1.0, .def = 0.5, .source = "test"}));
    }
    [[nodiscard]] Outline outline() const {
        return prism(width, width).to(0, width).to(-20_mm, width).gripped_at(-30_mm);
    }
};
struct Grind {
    double stiffness, share;

    struct State {
        double count = 7.0, diameter = 0.0, speed = 0.0, voxel = 0.0;
    };
    struct Notes {
        double depth = -1.0;
        bool is_near = false;
    };
    struct Signals {
        double depth = 0.0, turns = 0.0;
    };
    enum class Happened { touched, left };

    static constexpr auto about() {
        return describe(
            "grind", "A law.", budget_us(7),
            param(&Grind::stiffness, {.id = "stiffness",
                                      .help = "Of bone.",
                                      .unit = unit::N_per_mm,
                                      .min = 1_N_per_mm,
                                      .max = 900_N_per_mm,
                                      .def = 500_N_per_mm,
                                      .source = "test"}),
            param(&Grind::share,
                  {.id = "share", .help = "A fraction.", .min = 0.0, .max = 1.0, .def = 0.25, .source = "test"}),
            signal(&Signals::depth, {.id = "depth", .help = "Of the tip.", .unit = unit::mm}),
            signal(&Signals::turns, {.id = "turns", .help = "So far."}),
            event(Happened::touched, {.id = "grinding.touched", .help = "It touched."}),
            event(Happened::left, {.id = "test.grinding.left", .help = "It left."}),
            effect(&Grind::share, {.id = "sharing", .help = "It shares.", .off = 0.0}));
    }
    void begin(const Held<Rod>& rod, const BoneQuery& bone, State& state) const noexcept {
        state.diameter = rod.diameter;
        state.speed = rod.speed;
        state.voxel = bone.voxel();
    }
    [[nodiscard]] Notes resist(const Held<Rod>& rod, const BoneQuery&, const State& state,
                               Channels& channels) const noexcept {
        channels.contact(
            {.id = 3, .at = {0, 0, -rod.length}, .along = {1, 0, 0}, .stiffness = stiffness, .depth = share * 1_mm});
        return {.depth = state.count, .is_near = true};
    }
    void commit(const Held<Rod>& rod, const BoneQuery&, const Noted<Notes>& advance, State& state, Signals& signals,
                Actions& actions) const noexcept {
        state.count += rod.tick.dt;
        signals.depth = advance.notes.depth;
        signals.turns = advance.has_law ? 1.0 : 0.0;
        actions.cut();
        actions.event(advance.notes.is_near ? Happened::left : Happened::touched);
    }
};
/// A law of two tools.
struct Rub {
    static constexpr auto about() { return describe("rub", "A law."); }
    void resist(const Held<Bar, Rod>& tool, const BoneQuery&, Channels& channels) const noexcept {
        const double size = tool.visit([](const auto& held) {
            if constexpr (requires { held.width; })
                return held.width;
            else
                return held.diameter;
        });
        channels.friction({.id = tool.is<Rod>() ? 1u : 2u, .along = {0, 0, 1}, .limit = size});
    }
};
/// A law of any tool that has a diameter and a speed.
struct Spin {
    struct Tool {
        double speed, diameter;
        static constexpr auto needs() {
            return describe_needs(need_drive(&Tool::speed, {.id = "speed", .help = "Turns.", .unit = unit::rpm}),
                                  need(&Tool::diameter, {.id = "diameter", .help = "Across.", .unit = unit::mm}));
        }
    };
    static constexpr auto about() { return describe("spin", "A law."); }
    void resist(const Held<Tool>& tool, const BoneQuery&, Channels& channels) const noexcept {
        channels.push({tool.speed, tool.diameter, tool.tick.outline.empty() ? 0.0 : tool.tick.outline[1].radius}, {});
    }
};
constexpr kerf_entry entry = PluginTables<Bar, Rod, Grind, Rub, Spin>::entry("test.grinding", "1.0", "Apache-2.0");
const kerf_component &bar = entry.components[0], &rod = entry.components[1], &grind = entry.components[2],
                     &rub = entry.components[3], &spin = entry.components[4];

/// The input of a law whose tool is a rod of 3 mm by 40 mm at 600 rpm.
struct Asked {
    double tool[2] = {3_mm, 40_mm}, force[2] = {100_N_per_mm, 0.5}, drive[1] = {600_rpm};
    kerf_bone_query bone{sizeof(kerf_bone_query), 1, 2.0e-3, nullptr, nullptr, nullptr, nullptr};
    kerf_tick_in in{};

    Asked() {
        in.size = sizeof in;
        in.dt = 1e-3;
        in.tool_params = tool;
        in.tool_param_count = 2;
        in.force_params = force;
        in.drive = drive;
        in.bone = &bone;
    }
};
struct Law {
    kerf_channel channel[KERF_MAX_CHANNELS]{};
    kerf_law law{};

    Law(const kerf_component& component, const kerf_tick_in& in, const void* state) {
        law.channel = channel;
        EXPECT_EQ(component.force->resist(&in, state, &law), KERF_OK);
    }
};
Grind::State begun(const kerf_tick_in& in) {
    Grind::State state;
    std::memset(static_cast<void*>(&state), 0xab, sizeof state);  // whatever was there
    grind.force->begin(&in, &state);
    return state;
}

TEST(Tables, DescribeToolsAsTheyAreWritten) {
    EXPECT_STREQ(rod.id, "rod");
    EXPECT_EQ(rod.kind, std::uint32_t{KERF_KIND_TOOL});
    ASSERT_EQ(rod.param_count, 2u);
    EXPECT_STREQ(rod.params[1].id, "length");
    EXPECT_STREQ(rod.params[1].display_unit, "mm");
    EXPECT_TRUE(rod.params[1].dimension == dimension::length);
    EXPECT_EQ(rod.params[1].min, 1e-3);
    EXPECT_EQ(rod.params[1].def, 50 * 1e-3);
    ASSERT_EQ(rod.tool->drive_count, 1u);
    EXPECT_EQ(rod.tool->drives[0].max, 6000 * (1.0 / 60.0));
    EXPECT_EQ(rod.tool->drives[0].least, 6 * (1.0 / 60.0));
}

TEST(Tables, DescribeLawsAsTheyAreWritten) {
    const kerf_force& force = *grind.force;
    EXPECT_EQ(force.state_size, sizeof(Grind::State));
    EXPECT_EQ(force.budget_ns, 7000u);
    ASSERT_EQ(force.signal_count, 2u);
    EXPECT_STREQ(force.signals[1].id, "turns");
    ASSERT_EQ(force.event_count, 2u);
    EXPECT_STREQ(force.events[1].id, "test.grinding.left");
    ASSERT_EQ(grind.feature_count, 1u);
    EXPECT_EQ(grind.features[0].param, 1u);
    ASSERT_EQ(force.tool_count, 1u);
    EXPECT_STREQ(force.tools[0], "rod");
    EXPECT_EQ(force.need_count, 0u);
    EXPECT_EQ(rub.force->tool_count, 2u);
    EXPECT_EQ(rub.force->budget_ns, 20000u) << "unless it states one";
}

TEST(Tables, GiveAToolItsValues) {
    kerf_profile_point point[8];
    kerf_tool_shape shape{};
    shape.profile = point;
    shape.profile_capacity = 8;
    const double values[] = {3_mm, 40_mm};
    ASSERT_EQ(rod.tool->shape(values, &shape), KERF_OK);
    EXPECT_EQ(point[1].z, -3_mm);
    EXPECT_EQ(point[2].z, -40_mm);
    const double of_bar[] = {2_mm, 0.75};
    EXPECT_EQ(value_of<Bar>(of_bar).edge[1], 0.75);
    EXPECT_EQ(defaults_of<Rod>().speed, 60 * (1.0 / 60.0));
    EXPECT_EQ(defaults_of<Grind>().share, 0.25);
}

TEST(Law, BeginsWithDefaultsToolAndBone) {
    const Grind::State state = begun(Asked().in);
    EXPECT_EQ(state.count, 7.0);
    EXPECT_EQ(state.diameter, 3_mm);
    EXPECT_EQ(state.speed, 600_rpm);
    EXPECT_DOUBLE_EQ(state.voxel, 0.5e-3);
}

TEST(Law, ResistsByItsParameters) {
    const Asked asked;
    const Grind::State state = begun(asked.in);
    const Law law(grind, asked.in, &state);
    ASSERT_EQ(law.law.count, 1u);
    EXPECT_EQ(law.channel[0].kind, std::uint32_t{KERF_CONTACT});
    EXPECT_EQ(law.channel[0].id, 3u);
    EXPECT_EQ(law.channel[0].k, 1e5);
    EXPECT_EQ(law.channel[0].delta, 0.5e-3);
    EXPECT_EQ(law.channel[0].d[0], 1.0);
    EXPECT_EQ(law.channel[0].d[4], -40_mm) << "the moment about the tip of a push along x, 40 mm behind it";
}

TEST(Law, HandsItsNotesOnToItsCommit) {
    const Asked asked;
    Grind::State state = begun(asked.in);
    const Law law(grind, asked.in, &state);
    kerf_advance advance{};
    advance.note = law.law.note;
    double signal[2] = {-5.0, -5.0};
    kerf_action action[KERF_MAX_ACTIONS]{};
    kerf_commit_out out{sizeof(kerf_commit_out), 0, action, signal, nullptr, 0, 0};
    ASSERT_EQ(grind.force->commit(&asked.in, &advance, &state, &out), KERF_OK);
    EXPECT_EQ(signal[0], 7.0);
    EXPECT_EQ(signal[1], 1.0);
    EXPECT_EQ(state.count, 7.0 + 1e-3);
    ASSERT_EQ(out.action_count, 2u);
    EXPECT_EQ(action[0].kind, std::uint32_t{KERF_ACTION_CUT});
    EXPECT_EQ(action[1].value, 1u) << "left";
    EXPECT_EQ(signals_of<Grind>(signal).turns, 1.0);

    advance.note = nullptr;
    ASSERT_EQ(grind.force->commit(&asked.in, &advance, &state, &out), KERF_OK);
    EXPECT_EQ(signal[0], -1.0) << "as constructed";
    EXPECT_EQ(signal[1], 0.0);
    EXPECT_EQ(action[1].value, 0u) << "touched";
}

TEST(Law, GetsTheToolThatIsHeld) {
    Asked asked;
    asked.in.tool = 1;
    const Law with_rod(rub, asked.in, nullptr);
    EXPECT_EQ(with_rod.channel[0].id, 1u);
    EXPECT_EQ(with_rod.channel[0].tau, 3_mm);
    asked.tool[0] = 2_mm;
    asked.in.tool = 0;
    const Law with_bar(rub, asked.in, nullptr);
    EXPECT_EQ(with_bar.channel[0].id, 2u);
    EXPECT_EQ(with_bar.channel[0].tau, 2_mm);
}

TEST(Law, ReadsItsNeedsWhereTheyAreBound) {
    Asked asked;
    const std::uint32_t bound[] = {0, 0};
    const kerf_profile_point profile[] = {{0, 0}, {-1_mm, 4_mm}};
    const kerf_solid outline{sizeof(kerf_solid), KERF_SOLID_REVOLUTION, profile, 2, 0, 0, 0.0, 0, 0, {}};
    asked.in.bound = bound;
    asked.in.outline = &outline;
    ASSERT_EQ(spin.force->need_count, 2u);
    EXPECT_EQ(spin.force->tool_count, 0u);
    EXPECT_EQ(spin.force->needs[0].kind, std::uint32_t{KERF_NEED_DRIVE});
    EXPECT_STREQ(spin.force->needs[1].id, "diameter");
    const Law law(spin, asked.in, nullptr);
    EXPECT_EQ(law.law.wrench[0], 600_rpm);
    EXPECT_EQ(law.law.wrench[1], 3_mm);
    EXPECT_EQ(law.law.wrench[2], 4_mm);
}

TEST(Channels, RefuseMoreThanThereIsRoomFor) {
    kerf_channel channel[KERF_MAX_CHANNELS]{};
    kerf_law law{};
    law.channel = channel;
    Channels channels(law);
    for (std::uint32_t i = 0; i < KERF_MAX_CHANNELS + 2; ++i)
        channels.cut({.id = i, .along = {0, 0, 1}, .edge_force = 1.0, .slope = 1.0});
    EXPECT_EQ(channels.count(), KERF_MAX_CHANNELS);
    EXPECT_EQ(channels.dropped(), 2);
    EXPECT_EQ(channel[0].w, 1e-6) << "the sharpest onset there is";
}

}  // namespace
}  // namespace kerf
