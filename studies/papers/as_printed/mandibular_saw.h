// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "kerf/plugin.hpp"
#include "paper_units.h"

/// The reciprocating saw as [mandibular-angle] prints it, section IV.B, equations (1) to (6). Slips are kept; the marks
/// E04-… say which, and the tests show what each does.
namespace kerf::as_printed {

/// The saw of the paper, without a motor: a straight blade that moves to and fro along x and is fed along z.
struct PaperReciprocatingSaw {
    double length, height, stroke, kerf;
    double reciprocation;

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "paper_reciprocating_saw", "A reciprocating saw as [mandibular-angle] has it.",
            param(&PaperReciprocatingSaw::length, {.id = "length",
                                                   .help = "Of the cutting edge.",
                                                   .unit = unit::mm,
                                                   .min = 5.0_mm,
                                                   .max = 90.0_mm,
                                                   .def = 50.0_mm,
                                                   .source = "[mandibular-angle] section VI: 5.0 cm"}),
            param(&PaperReciprocatingSaw::height, {.id = "height",
                                                   .help = "From the back edge to the cutting edge.",
                                                   .unit = unit::mm,
                                                   .min = 2.0_mm,
                                                   .max = 40.0_mm,
                                                   .def = 10.0_mm,
                                                   .source = not_stated}),
            param(&PaperReciprocatingSaw::stroke, {.id = "stroke",
                                                   .help = "From one turning point to the other: twice A.",
                                                   .unit = unit::mm,
                                                   .min = 0.5_mm,
                                                   .max = 15.0_mm,
                                                   .def = 3.0_mm,
                                                   .source = not_stated}),
            param(&PaperReciprocatingSaw::kerf, {.id = "kerf",
                                                 .help = "Thickness of the blade. The paper ignores it.",
                                                 .unit = unit::mm,
                                                 .min = 0.2_mm,
                                                 .max = 4.0_mm,
                                                 .def = 1.0_mm,
                                                 .source = not_stated}),
            drive(&PaperReciprocatingSaw::reciprocation, {.id = "reciprocation",
                                                          .help = "F: to and fro is one; no motor is modelled.",
                                                          .unit = unit::per_min,
                                                          .min = 0.0,
                                                          .max = 25000.0_rpm,
                                                          .def = 15000.0_rpm}));
    }
    [[nodiscard]] Outline outline() const noexcept {
        using namespace literals;
        const double half = 0.5 * (length + stroke);
        return prism(kerf, kerf).to(0.0, half).to(-1.0_mm, half).cuts().to(-height, half).gripped_at(-height - 80.0_mm);
    }
};

/// A 3 × 3 matrix by rows.
using Matrix3 = std::array<Vec3, 3>;
[[nodiscard]] Vec3 times(const Matrix3& m, Vec3 v) noexcept;

/// K = I/M + r* J⁻¹ r*, below equation (1). As printed with the wrong sign (E04-1): r* is skew, so the second term
/// takes away from the first. Singular where r is the radius of gyration, negative beyond.
/// @param inverse_inertia  the diagonal of J⁻¹ [1/(kg·m²)]
[[nodiscard]] Matrix3 collision_matrix_as_printed(double mass, Vec3 inverse_inertia, Vec3 r) noexcept;

/// p = K⁻¹ (u' − u), u' = −e u: equation (1). As printed the whole velocity is reversed, not its normal part (E04-2).
[[nodiscard]] Vec3 sticking_as_printed(const Matrix3& k, Vec3 u, double restitution) noexcept;

/// p = −(e + 1) u (N − μT)/(Nᵀ K (N − μT)): equation (2). As printed the numerator multiplies two vectors (E04-3); here
/// component by component, the only reading that leaves a vector. T is the direction of the whole velocity, not of its
/// tangential part (E04-4).
[[nodiscard]] Vec3 sliding_as_printed(const Matrix3& k, Vec3 u, Vec3 normal, double restitution,
                                      double friction) noexcept;
/// Nᵀ K (N − μT) with that T.
[[nodiscard]] double denominator_as_printed(const Matrix3& k, Vec3 u, Vec3 normal, double friction) noexcept;

/// The torques of a force at `arm`, of its part across the blade and of its part in the plane of the blade: equations
/// (4) and (5). The paper ignores the first and compares the second with a threshold. As the arm lies in that plane
/// too, the second is always along the blade's normal: a twist about the long axis never shows in it.
struct TorqueParts {
    Vec3 across, in_plane;  ///< τ_n, τ_t [N·m]
};
[[nodiscard]] TorqueParts torque_parts(Vec3 arm, Vec3 force) noexcept;

struct MandibularSaw {
    double mass, gyration, restitution, friction, points;

    struct Signals {
        double contacts = 0.0, f_x = 0.0, f_y = 0.0, f_z = 0.0, torque = 0.0;
    };
    static constexpr auto about() {
        using namespace literals;
        return describe(
            "mandibular_saw", "[mandibular-angle] section IV.B, as printed.",
            param(&MandibularSaw::mass, {.id = "mass",
                                         .help = "M: of the saw.",
                                         .unit = unit::kg,
                                         .min = 1e-6_kg,
                                         .max = 10.0_kg,
                                         .def = 1e-3_kg,
                                         .source = not_stated}),
            param(&MandibularSaw::gyration, {.id = "gyration",
                                             .help = "Radius of gyration: J = M times its square.",
                                             .unit = unit::mm,
                                             .min = 5.0_mm,
                                             .max = 500.0_mm,
                                             .def = 50.0_mm,
                                             .source = not_stated}),
            param(&MandibularSaw::restitution, {.id = "restitution",
                                                .help = "e.",
                                                .min = 0.0,
                                                .max = 1.0,
                                                .def = 0.6,
                                                .source = "[mandibular-angle] section IV.B"}),
            param(&MandibularSaw::friction, {.id = "friction",
                                             .help = "μ.",
                                             .min = 0.0,
                                             .max = 1.5,
                                             .def = 0.3,
                                             .source = "[mandibular-angle] section IV.B"}),
            param(&MandibularSaw::points, {.id = "points",
                                           .help = "Sample points on the cutting edge; as many on the back edge.",
                                           .min = 1.0,
                                           .max = 128.0,
                                           .def = 86.0,
                                           .source = "[mandibular-angle] section VI: 86"}),
            signal(&Signals::contacts, {.id = "contacts", .help = "Points of the cutting edge in contact."}),
            signal(&Signals::f_x, {.id = "f_x", .help = "Along the blade.", .unit = unit::N}),
            signal(&Signals::f_y, {.id = "f_y", .help = "Across the blade.", .unit = unit::N}),
            signal(&Signals::f_z, {.id = "f_z", .help = "Against the feed.", .unit = unit::N}),
            signal(&Signals::torque,
                   {.id = "torque", .help = "Size of the torque that the paper compares.", .unit = unit::N_m}),
            budget_us(1000));
    }
    struct State {
        double phase = 0.0;  ///< [rad]
        Vec6 rate{};         ///< of the last interval, tool frame
    };

    void resist(const Held<PaperReciprocatingSaw>& tool, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept;
    void commit(const Held<PaperReciprocatingSaw>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::as_printed
