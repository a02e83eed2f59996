// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "kerf/exact_math.hpp"
#include "kerf/plugin.hpp"
#include "paper_units.h"

/// Torque of a dental implant as [dental-implant-2013] prints it: equations 14 to 18, figure 4. Slips are kept; the
/// marks E02-… name them, and the tests show what each does.
namespace kerf::as_printed {

inline constexpr const char* implant_point =
    "no paper reports it; calibrated: 0.2 N m fully inserted and 0.4 N m tightened in bone of 1 g/cm3, near the 39.7 N "
    "cm of [turkyilmaz-2006]";

/// The implant of the paper, on a driver. A right-hand thread: it goes in while it turns about +z.
struct PaperImplant {
    double diameter, pitch, thread_length, neck_length, head_diameter;

    static constexpr auto about() {
        using namespace literals;
        return describe("paper_implant", "A dental implant as [dental-implant-2013] has it, on its driver.",
                        param(&PaperImplant::diameter, {.id = "diameter",
                                                        .help = "Diameter over the crests of the thread.",
                                                        .unit = unit::mm,
                                                        .min = 1.0_mm,
                                                        .max = 10.0_mm,
                                                        .def = 4.0_mm,
                                                        .source = not_stated}),
                        param(&PaperImplant::pitch, {.id = "pitch",
                                                     .help = "Distance from crest to crest.",
                                                     .unit = unit::mm,
                                                     .min = 0.2_mm,
                                                     .max = 5.0_mm,
                                                     .def = 1.0_mm,
                                                     .source = not_stated}),
                        param(&PaperImplant::thread_length, {.id = "thread_length",
                                                             .help = "Length of the thread from the tip.",
                                                             .unit = unit::mm,
                                                             .min = 1.0_mm,
                                                             .max = 30.0_mm,
                                                             .def = 10.0_mm,
                                                             .source = not_stated}),
                        param(&PaperImplant::neck_length, {.id = "neck_length",
                                                           .help = "Length without thread under the head.",
                                                           .unit = unit::mm,
                                                           .min = 0.0,
                                                           .max = 10.0_mm,
                                                           .def = 0.0,
                                                           .source = not_stated}),
                        param(&PaperImplant::head_diameter, {.id = "head_diameter",
                                                             .help = "Diameter of the head.",
                                                             .unit = unit::mm,
                                                             .min = 1.0_mm,
                                                             .max = 16.0_mm,
                                                             .def = 6.0_mm,
                                                             .source = not_stated}));
    }
    [[nodiscard]] Outline outline() const noexcept;
};

/// The three torque modes of figure 4.
enum class TorqueMode { insertion, tightening, stripping };

/// Returns K of equations 15 to 17 [N m³/kg], continuous between the modes.
/// @param theta  [rad] turned since tightening began, 0 … 2π
[[nodiscard]] double contact_stiffness(double k_ins, double s, TorqueMode mode, double theta) noexcept;

/// Returns the mode of the next loop, figure 4. As printed tightening begins when all thread elements are in bone,
/// where the text says that the head touches the bone (E02-10), and ends after one turn in any bone (E02-12).
/// @param touching  thread elements in bone, of `count`
[[nodiscard]] TorqueMode next_mode(TorqueMode mode, std::size_t touching, std::size_t count, double theta) noexcept;

/// T = Σ Δ_i K D_i r_i (14, 18). Each element counts the same, whatever its length (P6). The law removes no bone.
struct ImplantTorque {
    double k_ins, s, wear, elements_per_turn;

    struct Notes {
        double torque = 0.0;  ///< [N·m] T of this loop
        std::size_t touching = 0, count = 0;
    };
    struct Signals {
        double torque = 0.0, mode = 0.0, tightened = 0.0, elements = 0.0;
    };
    static constexpr auto about() {
        using namespace literals;
        return describe(
            "implant_torque", "[dental-implant-2013] equations 14 to 18, as printed.",
            param(&ImplantTorque::k_ins, {.id = "k_ins",
                                          .help = "K_ins of each thread element: force per density.",
                                          .unit = n_per_density,
                                          .min = 0.0,
                                          .max = in(n_per_density, 1.0),
                                          .def = in(n_per_density, 6.25e-4),
                                          .source = implant_point}),
            param(&ImplantTorque::s, {.id = "s",
                                      .help = "Growth of K in tightening, for each radian.",
                                      .min = 0.0,
                                      .max = 10.0,
                                      .def = 1.0 / (2.0 * pi),
                                      .source = implant_point}),
            param(&ImplantTorque::wear, {.id = "wear",
                                         .help = "Density that each loop of stripping takes from each element.",
                                         .unit = unit::g_per_cm3,
                                         .min = 0.0,
                                         .max = 1.0_g_per_cm3,
                                         .def = 0.001_g_per_cm3,
                                         .source = not_stated}),
            param(&ImplantTorque::elements_per_turn, {.id = "elements_per_turn",
                                                      .help = "Thread elements on one turn of the helix.",
                                                      .min = 1.0,
                                                      .max = 64.0,
                                                      .def = 16.0,
                                                      .source = not_stated}),
            signal(&Signals::torque, {.id = "torque", .help = "Torque against the turn.", .unit = unit::N_m}),
            signal(&Signals::mode, {.id = "mode", .help = "0 insertion, 1 tightening, 2 stripping."}),
            signal(&Signals::tightened,
                   {.id = "tightened", .help = "Angle turned since tightening began.", .unit = unit::deg}),
            signal(&Signals::elements, {.id = "elements", .help = "Thread elements in bone."}), budget_us(1000));
    }

    struct State {
        TorqueMode mode = TorqueMode::insertion;
        double theta = 0.0;      ///< [rad] turned since tightening began, 0 … 2π
        double worn = 0.0;       ///< [kg/m³] taken from each element's density by the loops of stripping
        double turn_rate = 0.0;  ///< [rad/s] of the last interval
    };

    /// Turns against the last interval's turn. As printed a screw that rests feels no torque (E02-11).
    [[nodiscard]] Notes resist(const Held<PaperImplant>& tool, const BoneQuery& bone, const State& state,
                               Channels& channels) const noexcept;
    /// Wears the bone once in each loop of stripping, whether the screw turns or rests (E02-9).
    void commit(const Held<PaperImplant>& tool, const BoneQuery& bone, const Noted<Notes>& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::as_printed
