// SPDX-License-Identifier: Apache-2.0
// A round file, which cuts on its side only: for the tests of the kit that feed a tool as it declares.
#include <array>
#include <kerf/edge_law.hpp>
#include <kerf/plugin.hpp>

using namespace kerf;

namespace {

struct RoundFile {
    double diameter, length;
    static constexpr auto about() {
        return describe("round_file", "A cylinder with teeth and a safe tip.",
#if !defined(KERF_DECLARES_NO_FEED)
                        fed_sideways(),
#endif
                        param(&RoundFile::diameter, {.id = "diameter",
                                                     .help = "Over the teeth.",
                                                     .unit = unit::mm,
                                                     .min = 2_mm,
                                                     .max = 8_mm,
                                                     .def = 4_mm,
                                                     .source = "assumed"}),
                        param(&RoundFile::length, {.id = "length",
                                                   .help = "Of the teeth along the shaft.",
                                                   .unit = unit::mm,
                                                   .min = 6_mm,
                                                   .max = 40_mm,
                                                   .def = 12_mm,
                                                   .source = "assumed"}));
    }
    Outline outline() const {
        const double r = diameter / 2;
        return revolution({{0, 0.6 * r}, {-1_mm, r}})
            .safe()
            .to(-1_mm - length, r)
            .cuts()
            .to(-60_mm - length, r)
            .gripped_at(-90_mm - length);
    }
};

/// F = p m(ρ) A along each of six directions, at two heights, with A the patch of that point.
struct Filing {
    double pressure;
    struct State {};
    static constexpr auto about() {
        return describe("filing", "Teeth that take bone sideways; contact at the safe tip and the shaft.",
                        work({.channels = 16, .points = 16, .queries = 6}),
                        param(&Filing::pressure, {.id = "pressure",
                                                  .help = "Push per area of teeth in dense bone.",
                                                  .unit = unit::N_per_mm2,
                                                  .min = 0.1_N_per_mm2,
                                                  .max = 20_N_per_mm2,
                                                  .def = 2_N_per_mm2,
                                                  .source = "assumed"}));
    }
    void resist(const Held<RoundFile>& file, const BoneQuery& bone, const State&, Channels& channels) const noexcept {
        constexpr std::size_t around = 6, heights = 2, count = around * heights;
        const double r = file.diameter / 2, area = 2 * pi * r * file.length / count;
        std::array<Vec3, count> at, out;
        for (std::size_t i = 0; i < count; ++i) {
            const SinCos angle = sin_cos_exact(2 * pi * static_cast<double>(i % around) / around);
            out[i] = {angle.cos, angle.sin, 0};
            at[i] = r * out[i] - Vec3{0, 0, 1_mm + (i < around ? 0.3 : 0.7) * file.length};
        }
        std::array<kerf_bone_sample, count> found;
        bone.sample(at, out, found);
        for (std::uint32_t i = 0; i < count; ++i)
            if (const double m = resistance(found[i], bone.tissue_count(), 1850.0); m > 0)
                channels.cut({.id = i,
                              .at = at[i],
                              .along = out[i],
                              .edge_force = pressure * area * m,
                              .onset = 0.1_mm_per_s,
                              .slope = 500 * m,
                              .gap = found[i].gap});
        const std::array<Vec3, 4> smooth{{{0, 0, 0}, {0.6 * r, 0, 0}, {-0.6 * r, 0, 0}, {0, 0, -3_mm - file.length}}};
        for (std::uint32_t i = 0; i < smooth.size(); ++i)
            if (const SurfacePoint s = bone.nearest(smooth[i]); s.is_within(0.3_mm))
                channels.contact(
                    {.id = 20 + i, .at = smooth[i], .along = -s.normal, .stiffness = 5e5, .depth = -s.distance});
    }
    void commit(const Held<RoundFile>&, const BoneQuery&, const Advance& advance, State&,
                Actions& actions) const noexcept {
        if (advance.force_of_kind(KERF_CUT) > 0) actions.cut();
    }
};

}  // namespace

KERF_PLUGIN("example.round_file", "0.1.0", "Apache-2.0", RoundFile, Filing)
