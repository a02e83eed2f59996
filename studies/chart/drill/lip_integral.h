// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/component_info.h"
#include "kerf/math.hpp"

/// What the edges of a twist drill meet, integrated along them: the reference that methods are held against.
/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A twist drill with two lips. Tool frame: origin at the tip, +z out of the tip.
struct Drill {
    double diameter = 5.4e-3;     ///< [m]
    double point_angle = 2.0595;  ///< [rad] full
    double web = 0.15;            ///< [–] over the diameter

    [[nodiscard]] double radius() const noexcept { return 0.5 * diameter; }
    [[nodiscard]] double half_web() const noexcept { return 0.5 * web * diameter; }
    /// Where chisel edge and lips meet [m]: half web over sin 55° (chisel angle 125°, standard grind).
    [[nodiscard]] double chisel_radius() const noexcept;
    [[nodiscard]] double point_depth() const noexcept;  ///< R cot p [m]
};

/// f(t) = K_e (1 − e^(−t/t_e)) + K_c t per width of cut [N/m]; t the chip thickness [m].
struct EdgeLaw {
    double edge = 0.0;  ///< K_e [N/m]
    double chip = 0.0;  ///< K_c [N/m²]
};
/// The drilling plugin's law, by its parameters' names. Source: docs/models/drilling.md.
struct CuttingLaw {
    EdgeLaw thrust, cutting, chisel;
    double edge_depth = 4e-6;           ///< t_e [m]
    double reference_density = 1850.0;  ///< [kg/m³]
    double relief = 0.1745;             ///< [rad]; beyond 2π r tan(relief) per revolution the heel rides up

    /// (ρ/ρ_ref)² [–].
    [[nodiscard]] double resistance(double density) const noexcept;
    [[nodiscard]] double per_width(double t, const EdgeLaw& edge) const noexcept;
};
/// Empty if `force` lacks one of the parameters.
[[nodiscard]] std::optional<CuttingLaw> cutting_law_of(const std::vector<ParameterInfo>& force);

/// A drill has four edges: two lips and two halves of the chisel edge. `s` runs along an edge's projection across the
/// shaft, away from the shaft [m].
inline constexpr int edge_count = 4;
[[nodiscard]] constexpr bool is_lip(int edge) noexcept { return edge < 2; }
struct Span {
    double from, to;
};  ///< [m]
[[nodiscard]] Span span_of(const Drill& drill, int edge) noexcept;
/// Where an edge's point lies, the first lip at `angle` [rad]. Tool frame [m].   [any] pure.
[[nodiscard]] Vec3 place_on_edge(const Drill& drill, int edge, double s, double angle) noexcept;

/// A stretch of an edge that lies in one tissue.
struct Stretch {
    double from, to;    ///< [m]
    double resistance;  ///< [–] 1 in the tissue that the law was calibrated in
};
using Engaged = std::array<std::vector<Stretch>, edge_count>;

/// What bone does to the tool: lips and chisel edge, all that is engaged at its front, at a feed of `per_lip` [m] per
/// lip. About the tip, tool frame [N, N·m].
///
///     thrust   Σ ∫ m f_n(t) n_z dw,   t = n_z per_lip,  dw = ds cos i / sin p
///     torque   Σ ∫ m f_c(t) r dw
///     lateral  Σ ∫ m (−f_c(t) t̂ − f_n(t) n_r r̂) dw
///
/// Between borders everything is smooth: Gauss–Legendre with eight points per stretch, within 1e-6.   [any] pure.
///
/// Source: geometry of [tsai-2007] with its normal made a unit vector, docs/models/drilling.md.
[[nodiscard]] Vec6 edge_wrench(const Drill& drill, const CuttingLaw& law, const Engaged& engaged, double angle,
                               double per_lip) noexcept;

/// All edges wholly in the tissue of resistance 1.
[[nodiscard]] Engaged wholly_engaged(const Drill& drill);

}  // namespace kerf::chart
