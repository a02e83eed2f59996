// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "printed_drill.h"

/// Drilling force as [dental-implant-2013] prints it, equations 4 to 13 and 19.
namespace kerf::as_printed {

/// Equations 8 to 10 for one element: F_n and F_t [N], θ between its normal and the drill's axis, α = ωt. As printed
/// all elements have the same α, so that opposite ones do not cancel (E02-5), and the tangential force goes with the
/// turn (E02-7).
[[nodiscard]] Vec3 element_force(double f_n, double f_t, SinCos theta, SinCos alpha) noexcept;

/// Equation 19: density at (x, y, z) from the eight nodes of a cell. As printed its weights take nodes 2 to 5 and 7 in
/// another order than the list of indices gives them: y and z change places (E02-3). x, y, z are taken as fractions of
/// the cell (E02-4).
/// @param nodes  in the order of the list of indices: (0,0,0) (1,0,0) (1,1,0) (0,1,0) (0,0,1) (1,0,1) (1,1,1) (0,1,1)
[[nodiscard]] double density_as_printed(const std::array<double, 8>& nodes, double x, double y, double z) noexcept;

/// F_n = Δ k_n D, F_t = Δ k_t D (4, 5): of the density alone. As printed neither feed nor speed matters, and a drill
/// that stands feels as much as one that is fed (E02-6); each element counts the same, whatever its length (P6). The
/// density is interpolated by the host, with nodes in their right order.
struct DentalImplant {
    double k_n, k_t, element_interval;

    struct Signals {
        double elements = 0.0;
    };
    static constexpr auto about() {
        using namespace literals;
        return describe("dental_implant", "[dental-implant-2013] equations 4 to 13, as printed.",
                        param(&DentalImplant::k_n, {.id = "k_n",
                                                    .help = "k^n of each element: normal force per density.",
                                                    .unit = n_per_density,
                                                    .min = 0.0,
                                                    .max = in(n_per_density, 1.0),
                                                    .def = in(n_per_density, 3.68e-3),
                                                    .source = femur_point}),
                        param(&DentalImplant::k_t, {.id = "k_t",
                                                    .help = "k^t of each element: tangential force per density.",
                                                    .unit = n_per_density,
                                                    .min = 0.0,
                                                    .max = in(n_per_density, 1.0),
                                                    .def = in(n_per_density, 3.13e-3),
                                                    .source = femur_point}),
                        as_printed::element_interval(&DentalImplant::element_interval),
                        signal(&Signals::elements, {.id = "elements", .help = "Cutting elements."}), budget_us(1000));
    }

    using State = LastInterval;

    void resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept;
    /// Asks about the elements once more: a host that wears bone where it is asked about does in each tick what
    /// updateDensity() does in each loop (section 3.2.3), so that removal follows the loop's rate (E02-8).
    void commit(const Held<PaperBit>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::as_printed
