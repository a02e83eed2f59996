// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "kerf/exact_math.hpp"
#include "kerf/plugin.hpp"
#include "paper_units.h"

/// Sawing as [hsieh-2006] prints it, sections 2.2 to 2.4. Its equations have no numbers: they are cited by section.
/// Slips are kept; the marks E03-… say which, and the tests show what each does.
namespace kerf::as_printed {

inline constexpr const char* saw_point =
    "determined empirically, figures not stated; 8, 5 and 0.8 N of a tooth at 1 mm/s and 12000 a minute: the order of "
    "[james-2012]";

/// The saw of the paper, without a motor.
struct PaperSaw {
    double length, tooth_pitch, tooth_count, bend, swing, kerf;
    double oscillation;

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "paper_saw", "An oscillating saw as [hsieh-2006] has it.",
            param(&PaperSaw::length, {.id = "length",
                                      .help = "l: from the saw's origin, which it swings about, to its tip.",
                                      .unit = unit::mm,
                                      .min = 20.0_mm,
                                      .max = 90.0_mm,
                                      .def = 60.0_mm,
                                      .source = not_stated}),
            param(&PaperSaw::tooth_pitch, {.id = "tooth_pitch",
                                           .help = "p: from tooth to tooth.",
                                           .unit = unit::mm,
                                           .min = 0.3_mm,
                                           .max = 5.0_mm,
                                           .def = 1.4_mm,
                                           .source = not_stated}),
            param(&PaperSaw::tooth_count, {.id = "tooth_count",
                                           .help = "Teeth.",
                                           .min = 1.0,
                                           .max = 64.0,
                                           .def = 10.0,
                                           .source = "[hsieh-2006] section 3: ten"}),
            param(&PaperSaw::bend, {.id = "bend",
                                    .help = "c: how the tips leave a straight line.",
                                    .unit = per_metre,
                                    .min = 0.0,
                                    .max = in(per_metre, 30.0),
                                    .def = 0.0,
                                    .source = "[hsieh-2006] section 2.2: 0 where tips form a line"}),
            param(&PaperSaw::swing, {.id = "swing",
                                     .help = "Angle from one turning point to the other.",
                                     .unit = unit::deg,
                                     .min = 0.0,
                                     .max = 12.0_deg,
                                     .def = 5.0_deg,
                                     .source = not_stated}),
            param(&PaperSaw::kerf, {.id = "kerf",
                                    .help = "Thickness of the blade.",
                                    .unit = unit::mm,
                                    .min = 0.2_mm,
                                    .max = 4.0_mm,
                                    .def = 1.0_mm,
                                    .source = not_stated}),
            drive(&PaperSaw::oscillation, {.id = "oscillation",
                                           .help = "u: oscillations; no motor is modelled.",
                                           .unit = unit::per_min,
                                           .min = 0.0,
                                           .max = 25000.0_rpm,
                                           .def = 12000.0_rpm}));
    }
    [[nodiscard]] Outline outline() const noexcept {
        using namespace literals;
        const double half = 0.5 * tooth_count * tooth_pitch;
        return prism(kerf, kerf).to(0.0, half).to(-1.0_mm, half).cuts().to(-length, half).gripped_at(-length - 80.0_mm);
    }
};
inline constexpr std::size_t max_saw_teeth = 64;

/// β of the tooth `offset` = n p [m] from the saw's axis (2.2): tan⁻¹(l/(np − c(np)²)). As printed a right angle for
/// the tooth in the middle (E03-2), where the text wants teeth at small angles. Places and forces therefore take the
/// fraction turned over, tan⁻¹(np/(l − c(np)²)): the printed one puts no tooth near bone.
[[nodiscard]] double tooth_angle_as_printed(double length, double offset, double bend) noexcept;

/// A = Δ w p f/u (2.4) [m³]. As printed a volume, not the area it is called (E03-1); 1/0 for a saw that stands.
[[nodiscard]] double chip_as_printed(double width, double pitch, double feed_rate, double oscillation) noexcept;

/// F_x, F_z of a tooth at θ (2.4): F_z = cos θ F_n − sin θ F_l, F_x = sin θ F_l + cos θ F_n. As printed no rotation:
/// the force along the feed comes back across it (E03-3). F_l has no sign: it does not turn with the oscillation
/// (E03-4).
struct SawForce {
    double x, z;
};
[[nodiscard]] SawForce saw_force(SinCos theta, double normal, double lateral) noexcept;

struct Hsieh2006 {
    double k_normal, k_lateral, k_radial, tooth_width, per_point, point_interval;

    struct Signals {
        double teeth_in_bone = 0.0, f_x = 0.0, f_y = 0.0, f_z = 0.0;
    };
    static constexpr auto about() {
        using namespace literals;
        return describe("hsieh_2006", "[hsieh-2006] sections 2.3 and 2.4, as printed.",
                        param(&Hsieh2006::k_normal, {.id = "k_normal",
                                                     .help = "K_normal, against the feed.",
                                                     .unit = n_per_mm3,
                                                     .min = 0.0,
                                                     .max = in(n_per_mm3, 1e15),
                                                     .def = in(n_per_mm3, 8.0 / 0.007e-9),
                                                     .source = saw_point}),
                        param(&Hsieh2006::k_lateral, {.id = "k_lateral",
                                                      .help = "K_lateral, along the oscillation.",
                                                      .unit = n_per_mm3,
                                                      .min = 0.0,
                                                      .max = in(n_per_mm3, 1e15),
                                                      .def = in(n_per_mm3, 5.0 / 0.007e-9),
                                                      .source = saw_point}),
                        param(&Hsieh2006::k_radial, {.id = "k_radial",
                                                     .help = "K_radial, across the blade.",
                                                     .unit = n_per_mm3,
                                                     .min = 0.0,
                                                     .max = in(n_per_mm3, 1e15),
                                                     .def = in(n_per_mm3, 0.8 / 0.007e-9),
                                                     .source = saw_point}),
                        param(&Hsieh2006::tooth_width, {.id = "tooth_width",
                                                        .help = "w: width of a tooth's blade.",
                                                        .unit = unit::mm,
                                                        .min = 0.1_mm,
                                                        .max = 4.0_mm,
                                                        .def = 1.0_mm,
                                                        .source = not_stated}),
                        param(&Hsieh2006::per_point, {.id = "per_point",
                                                      .help = "Force of one immersed point of a still saw.",
                                                      .unit = unit::N,
                                                      .min = 0.0,
                                                      .max = 1000.0_N,
                                                      .def = 0.1_N,
                                                      .source = "not stated: that of [tsai-2007]"}),
                        param(&Hsieh2006::point_interval, {.id = "point_interval",
                                                           .help = "Distance of sample points on the blade: one voxel.",
                                                           .unit = unit::mm,
                                                           .min = 0.1_mm,
                                                           .max = 5.0_mm,
                                                           .def = 1.0_mm,
                                                           .source = "[hsieh-2006] section 2.3"}),
                        signal(&Signals::teeth_in_bone, {.id = "teeth_in_bone", .help = "Teeth whose tip is in bone."}),
                        signal(&Signals::f_x, {.id = "f_x", .help = "Against the oscillation.", .unit = unit::N}),
                        signal(&Signals::f_y, {.id = "f_y", .help = "Across the blade.", .unit = unit::N}),
                        signal(&Signals::f_z, {.id = "f_z", .help = "Against the feed.", .unit = unit::N}),
                        budget_us(1000));
    }

    struct State {
        double phase = 0.0;  ///< [rad]
        Vec6 rate{};         ///< of the last interval, tool frame
    };

    /// Teeth while it oscillates (2.4), immersed points while it is still (2.3). Nothing is removed while sawing (2.1).
    void resist(const Held<PaperSaw>& tool, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept;
    void commit(const Held<PaperSaw>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::as_printed
