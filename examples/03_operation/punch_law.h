// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <kerf/edge_law.hpp>
#include <kerf/plugin.hpp>

/// A biopsy punch: a tube that is pushed into bone by hand and crushes what is under its rim.
namespace operation {

using namespace kerf;

struct Punch {
    double diameter, wall;

    static constexpr auto about() {
        return describe("punch", "A tube with a sharp rim, pushed by hand.",
                        param(&Punch::diameter, {.id = "diameter",
                                                 .help = "Outer diameter.",
                                                 .unit = unit::mm,
                                                 .min = 2_mm,
                                                 .max = 12_mm,
                                                 .def = 4_mm,
                                                 .source = "assumed: order of bone marrow trephines"}),
                        param(&Punch::wall, {.id = "wall",
                                             .help = "Thickness of its wall.",
                                             .unit = unit::mm,
                                             .min = 0.1_mm,
                                             .max = 1_mm,
                                             .def = 0.3_mm,
                                             .source = "assumed"}));
    }
    Outline outline() const {
        if (!(2 * wall < diameter))
            return refuse("`wall` is ", in_mm(wall), "; it needs less than half of `diameter`.");
        const double r = diameter / 2;
        return revolution({{0, r}, {-2_mm, r}}).cuts().to(-100_mm, r).gripped_at(-120_mm);
    }
};

/// What crushes the ring of bone under the rim:
///
///     F = S m(ρ) A,    A = π (d − w) w
///
/// with S = strength, m the resistance of the tissue relative to dense bone, d the diameter and w the wall. The core of
/// bone inside goes with it; this example removes it.
struct Crushing {
    double strength;

    struct Signals {
        double push = 0.0;
    };
    enum class Happened { entered };
    struct State {
        bool is_in_bone = false;
    };

    static constexpr auto about() {
        return describe("crushing", "The rim crushes the ring of bone under it.",
                        work({.channels = 5, .points = 12, .queries = 5}),
                        param(&Crushing::strength, {.id = "strength",
                                                    .help = "Pressure that crushes dense bone.",
                                                    .unit = unit::N_per_mm2,
                                                    .min = 1_N_per_mm2,
                                                    .max = 500_N_per_mm2,
                                                    .def = 40_N_per_mm2,
                                                    .source = "assumed"}),
                        signal(&Signals::push, {.id = "push", .help = "Push of the bone on the rim.", .unit = unit::N}),
                        event(Happened::entered, {.id = "operation.entered", .help = "The rim is in bone."}));
    }
    void resist(const Held<Punch>& punch, const BoneQuery& bone, const State&, Channels& channels) const noexcept {
        constexpr std::size_t around = 8;
        const double r = (punch.diameter - punch.wall) / 2, area = 2 * pi * r * punch.wall;
        std::array<Vec3, around> rim;
        for (std::size_t i = 0; i < around; ++i) {
            const SinCos angle = sin_cos_exact(2 * pi * static_cast<double>(i) / around);
            rim[i] = {r * angle.cos, r * angle.sin, 0};
        }
        std::array<kerf_bone_sample, around> found;
        bone.sample(rim, {0, 0, 1}, found);
        double crushed = 0, engaged = 0, gap = 1;
        for (const kerf_bone_sample& here : found) {
            const double m = resistance(here, bone.tissue_count(), 1850.0);
            if (m <= 0) continue;
            crushed += m / around;
            engaged += here.engagement / around;
            gap = std::min(gap, here.gap);
        }
        if (crushed > 0)
            channels.cut({.id = 1,
                          .along = {0, 0, 1},
                          .edge_force = strength * area * crushed,
                          .onset = 0.1_mm_per_s,
                          .slope = 1000 * engaged,
                          .gap = gap});
        for (std::uint32_t i = 0; i < 4; ++i) {  // the wall of its hole holds the tube
            const Vec3 side{i == 0 ? 1.0 : i == 1 ? -1.0 : 0.0, i == 2 ? 1.0 : i == 3 ? -1.0 : 0.0, 0};
            const Vec3 at = punch.diameter / 2 * side - Vec3{0, 0, 5_mm};
            if (const SurfacePoint s = bone.nearest(at); s.is_within(0.3_mm))
                channels.contact({.id = 2 + i, .at = at, .along = -s.normal, .stiffness = 5e5, .depth = -s.distance});
        }
    }
    void commit(const Held<Punch>&, const BoneQuery&, const Advance& advance, State& state, Signals& signals,
                Actions& actions) const noexcept {
        signals.push = advance.force_of_channel(1);
        if (signals.push > 0) actions.cut();
        if (signals.push > 0 && !state.is_in_bone) actions.event(Happened::entered);
        state.is_in_bone = state.is_in_bone || signals.push > 0;
    }
};

}  // namespace operation
