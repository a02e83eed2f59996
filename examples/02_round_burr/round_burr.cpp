// SPDX-License-Identifier: Apache-2.0
#include <kerf/edge_law.hpp>
#include <kerf/plugin.hpp>
#include <kerf/powered_cutter.hpp>

using namespace kerf;

constexpr Quantity slowest_cut = 300_rpm;                                        // it removes bone from here on
constexpr Quantity fading = 8_ms;                                                // of its cuts as it stops: assumed
constexpr Motor motor = Motor::with_run_up(0.3, 60000_rpm, 40_Nmm, 2e-7_kg_m2);  // assumed: order of a small burr

struct RoundBurr {
    double diameter, speed;
    static constexpr auto about() {
        return describe("round_burr", "A ball with teeth on a thin shank.",
                        param(&RoundBurr::diameter, {.id = "diameter",
                                                     .help = "Diameter of the ball.",
                                                     .unit = unit::mm,
                                                     .min = 1_mm,
                                                     .max = 10_mm,
                                                     .def = 4_mm,
                                                     .source = "assumed"}),
                        drive(&RoundBurr::speed, {.id = "speed",
                                                  .help = "Commanded speed.",
                                                  .unit = unit::rpm,
                                                  .min = 0.0,
                                                  .max = 60000_rpm,
                                                  .def = 40000_rpm,
                                                  .least = slowest_cut}));
    }
    Outline outline() const {  // the ball removes bone, to where it meets the shank behind its equator
        const double r = diameter / 2;
        return revolution().ball(-r, r, 150_deg).cuts().to(-60_mm, r / 2).gripped_at(-90_mm);
    }
};

struct Burring {
    double chip;
    struct State {
        PoweredCutter cutter;
    };
    struct Signals {
        double thrust = 0.0, speed = 0.0;
    };
    using Phase = Spindle::Phase;
    static constexpr auto about() {
        return describe(
            "burring", "Teeth that take chips all over the ball; contact while it is still.",
            work({.channels = 10, .points = 10, .queries = 6}),
            param(&Burring::chip, {.id = "chip",
                                   .help = "Force per chip area, normal to the surface and against the turn.",
                                   .unit = unit::N_per_mm2,
                                   .min = 1_N_per_mm2,
                                   .max = 5000_N_per_mm2,
                                   .def = 200_N_per_mm2,
                                   .source = "assumed: order of cortical bone"}),
            signal(&Signals::thrust, {.id = "thrust", .help = "Push of the bone.", .unit = unit::N}),
            signal(&Signals::speed, {.id = "speed", .help = "Actual speed.", .unit = unit::rpm}),
            event(Phase::off, {.id = "round_burr.off", .help = "The burr is still."}),
            event(Phase::spinning_up, {.id = "round_burr.speeding_up", .help = "It speeds up."}),
            event(Phase::running, {.id = "round_burr.running", .help = "It runs."}),
            event(Phase::reversing, {.id = "round_burr.reversing", .help = "It runs in reverse."}),
            event(Phase::bogging, {.id = "round_burr.bogging", .help = "Bone slows it down."}),
            event(Phase::stalled, {.id = "round_burr.stalled", .help = "Bone holds it fast."}),
            event(Phase::running_down, {.id = "round_burr.running_down", .help = "It runs down."}));
    }
    // Each of five directions stands for the part of the ball that faces it, of about 2 radius².
    void resist(const Held<RoundBurr>& burr, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept {
        constexpr std::array<Vec3, 5> out{{{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}};
        const double radius = burr.diameter / 2, speed = std::max<double>(state.cutter.speed(), slowest_cut);
        std::array<Vec3, 5> at;
        for (std::size_t i = 0; i < 5; ++i) at[i] = Vec3{0, 0, -radius} + radius * out[i];
        std::array<kerf_bone_sample, 5> found;
        bone.sample(at, out, found);
        for (std::uint32_t i = 0; i < 5; ++i) {
            const SurfacePoint s = bone.nearest(at[i]);
            const double m = resistance(found[i], bone.tissue_count(), 1850.0);
            if (state.cutter.cutting.resists() && m > 0.0)  // chip area a second: 2 radius² v; teeth pass at 2π radius
                channels.cut({.id = i,
                              .at = at[i],
                              .along = out[i],
                              .slope = state.cutter.cutting.fraction * chip * m * radius / (pi * speed),
                              .gap = found[i].gap,
                              .follow = rate_at(at[i], -cross(Vec3{0, 0, 1}, out[i]))});
            if (!state.cutter.cutting.removes_bone() && s.is_within(0.3_mm))  // it takes over as the teeth stop
                channels.contact({.id = 10 + i,
                                  .at = at[i],
                                  .along = -s.normal,
                                  .stiffness = 5e5 * (1 - state.cutter.cutting.fraction),
                                  .depth = -s.distance});
        }
    }
    void commit(const Held<RoundBurr>& burr, const BoneQuery&, const Advance& advance, State& state, Signals& signals,
                Actions& actions) const noexcept {
        const double cutting = advance.force_of_kind(KERF_CUT);
        signals = {.thrust = cutting, .speed = state.cutter.speed()};
        if (state.cutter.cutting.removes_bone()) actions.cut();
        state.cutter.step(motor, burr.speed, cutting * burr.diameter / 2, burr.tick.dt, slowest_cut, actions, fading);
    }
};

KERF_PLUGIN("example.round_burr", "0.1.0", "Apache-2.0", RoundBurr, Burring)
