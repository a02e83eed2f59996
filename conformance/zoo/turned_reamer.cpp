// SPDX-License-Identifier: Apache-2.0
// A reamer on a hand's T-handle, which cuts while it is turned: for the tests of the kit that feed a tool as it
// declares.
#include <array>
#include <cmath>
#include <kerf/edge_law.hpp>
#include <kerf/plugin.hpp>

using namespace kerf;

namespace {

struct HandReamer {
    double diameter;
    static constexpr auto about() {
        return describe("hand_reamer", "A cone with edges, turned by hand.",
#if !defined(KERF_DECLARES_NO_FEED)
                        fed_by_turning(),
#endif
                        param(&HandReamer::diameter, {.id = "diameter",
                                                      .help = "Over the edges.",
                                                      .unit = unit::mm,
                                                      .min = 3_mm,
                                                      .max = 8_mm,
                                                      .def = 4_mm,
                                                      .source = "assumed"}));
    }
    Outline outline() const {
        const double r = diameter / 2;
        return revolution({{0, 0}, {-r, r}, {-20_mm, r}}).cuts().to(-60_mm, r).gripped_at(-90_mm);
    }
};

/// On a cone F = p m(ρ) A along the shaft, while it turns: less than a turn in 5 mm is no cutting, and bone is hard.
struct Reaming {
    double pressure;
    struct State {
        bool is_turning = false;
    };
    static constexpr auto about() {
        return describe("reaming", "Edges on a cone that cut while they turn.",
                        work({.channels = 8, .points = 8, .queries = 1}),
                        param(&Reaming::pressure, {.id = "pressure",
                                                   .help = "Push per area of the cone in dense bone.",
                                                   .unit = unit::N_per_mm2,
                                                   .min = 0.1_N_per_mm2,
                                                   .max = 20_N_per_mm2,
                                                   .def = 2_N_per_mm2,
                                                   .source = "assumed"}));
    }
    void resist(const Held<HandReamer>& reamer, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept {
        constexpr std::size_t count = 6;
        const double r = reamer.diameter / 2, area = pi * r * r / count;
        std::array<Vec3, count> at, out;
        for (std::size_t i = 0; i < count; ++i) {
            const SinCos angle = sin_cos_exact(2 * pi * static_cast<double>(i) / count);
            out[i] = {std::sqrt(0.5) * angle.cos, std::sqrt(0.5) * angle.sin, std::sqrt(0.5)};
            at[i] = {0.7 * r * angle.cos, 0.7 * r * angle.sin, -0.7 * r};
        }
        if (!state.is_turning) {
            std::array<kerf_surface_point, count> near;
            bone.nearest(at, near);
            for (std::uint32_t i = 0; i < count; ++i)
                if (SurfacePoint{near[i]}.is_within(0.3_mm))
                    channels.contact({.id = 20 + i,
                                      .at = at[i],
                                      .along = -near[i].normal,
                                      .stiffness = 2e5,
                                      .depth = -near[i].distance});
            return;
        }
        std::array<kerf_bone_sample, count> found;
        bone.sample(at, out, found);
        for (std::uint32_t i = 0; i < count; ++i)
            if (const double m = resistance(found[i], bone.tissue_count(), 1850.0); m > 0)
                channels.cut({.id = i,
                              .at = at[i],
                              .along = {0, 0, 1},
                              .edge_force = pressure * area * m,
                              .onset = 0.1_mm_per_s,
                              .slope = 500 * m,
                              .gap = found[i].gap});
    }
    void commit(const Held<HandReamer>&, const BoneQuery&, const Advance& advance, State& state,
                Actions& actions) const noexcept {
        const double feed = std::hypot(advance.rate[0], advance.rate[1], advance.rate[2]);
        state.is_turning = std::abs(advance.rate[5]) > 2 * pi / 5e-3 * feed && std::abs(advance.rate[5]) > 0.1;
        if (state.is_turning && advance.force_of_kind(KERF_CUT) > 0) actions.cut();
    }
};

}  // namespace

KERF_PLUGIN("example.hand_reamer", "0.1.0", "Apache-2.0", HandReamer, Reaming)
