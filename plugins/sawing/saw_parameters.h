// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/describe.hpp"
#include "kerf/edge_law.hpp"
#include "kerf/force.hpp"

/// Parameters of a saw's law: coefficients of bone and teeth.
namespace kerf::sawing {

/// The parameters of the law, SI.
struct SawParameters {
    double thrust_edge, thrust_chip, cutting_edge, cutting_chip, edge_depth;
    double set_share, reference_density, contact_stiffness, friction;

    [[nodiscard]] EdgeCoefficients thrust() const noexcept { return {thrust_edge, edge_depth, thrust_chip}; }
    [[nodiscard]] EdgeCoefficients cutting() const noexcept { return {cutting_edge, edge_depth, cutting_chip}; }

    static constexpr auto about() {
        using namespace literals;
        constexpr const char* single_tooth =
            "calibrated: resultant 8 to 11 N of a tooth, thrust 1.28 times as large at 10 um as at 2 um, cutting force "
            "constant [james-2012, james-2013]; that the tooth was 1 mm wide is assumed";
        return group(
            param(&SawParameters::thrust_edge, {.id = "thrust_edge",
                                                .help = "Tooth: edge force against the feed, per width of cut.",
                                                .unit = unit::N_per_mm,
                                                .min = 0.0,
                                                .max = 500.0_N_per_mm,
                                                .def = 6.57_N_per_mm,
                                                .source = single_tooth}),
            param(&SawParameters::thrust_chip, {.id = "thrust_chip",
                                                .help = "Tooth: force against the feed, per chip area.",
                                                .unit = unit::N_per_mm2,
                                                .min = 0.0,
                                                .max = 10000.0_N_per_mm2,
                                                .def = 238.0_N_per_mm2,
                                                .source = single_tooth}),
            param(&SawParameters::cutting_edge, {.id = "cutting_edge",
                                                 .help = "Tooth: edge force against its motion, per width of cut.",
                                                 .unit = unit::N_per_mm,
                                                 .min = 0.0,
                                                 .max = 500.0_N_per_mm,
                                                 .def = 5.0_N_per_mm,
                                                 .source = single_tooth}),
            param(&SawParameters::cutting_chip,
                  {.id = "cutting_chip",
                   .help = "Tooth: force against its motion, per chip area.",
                   .unit = unit::N_per_mm2,
                   .min = 0.0,
                   .max = 10000.0_N_per_mm2,
                   .def = 0.0,
                   .source = "the cutting force is constant from 2 to 10 um [james-2013]"}),
            param(&SawParameters::edge_depth,
                  {.id = "edge_depth",
                   .help = "Chip thickness at which the edge force has built up.",
                   .unit = unit::um,
                   .min = 0.01_um,
                   .max = 20.0_um,
                   .def = 0.4_um,
                   .source = "assumed: the largest that leaves the published checks unchanged"}),
            param(&SawParameters::set_share,
                  {.id = "set_share",
                   .help = "Force of a tooth to the side it is set to, as a fraction of its thrust.",
                   .min = 0.0,
                   .max = 1.0,
                   .def = 0.1,
                   .source = "assumed; neighbours cancel"}),
            param(&SawParameters::reference_density, {.id = "reference_density",
                                                      .help = "Density of the bone the coefficients were fitted to.",
                                                      .unit = unit::g_per_cm3,
                                                      .min = 0.5_g_per_cm3,
                                                      .max = 2.5_g_per_cm3,
                                                      .def = 1.85_g_per_cm3,
                                                      .source = "assumed: middle of the cortical range"}),
            param(&SawParameters::contact_stiffness,
                  {.id = "contact_stiffness",
                   .help = "Stiffness of bone at each point where a side or the still teeth touch.",
                   .unit = unit::N_per_mm,
                   .min = 1.0_N_per_mm,
                   .max = 10000.0_N_per_mm,
                   .def = 500.0_N_per_mm,
                   .source = "assumed"}),
            param(&SawParameters::friction, {.id = "friction",
                                             .help = "Friction of steel on wet bone.",
                                             .min = 0.0,
                                             .max = 1.5,
                                             .def = 0.3,
                                             .source = "assumed"}),
            effect(&SawParameters::thrust_edge, {.id = "edge_term", .help = "Teeth resist also at almost no feed."}),
            effect(&SawParameters::cutting_edge, {.id = "edge_term", .help = "Teeth resist also at almost no feed."}),
            effect(&SawParameters::set_share,
                   {.id = "set_force", .help = "A tooth without a neighbour pushes the blade aside."}),
            effect(&SawParameters::friction, {.id = "friction", .help = "The sides rub where the blade binds."}));
    }
};

}  // namespace kerf::sawing
