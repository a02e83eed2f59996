// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/cutter_parameters.hpp"
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
            edge_force(&SawParameters::thrust_edge, {.id = "thrust_edge",
                                                     .help = "Tooth: edge force against the feed, per width of cut.",
                                                     .max = 500.0_N_per_mm,
                                                     .def = 6.57_N_per_mm,
                                                     .source = single_tooth}),
            chip_force(&SawParameters::thrust_chip, "thrust_chip", "Tooth: force against the feed, per chip area.",
                       238.0_N_per_mm2, single_tooth),
            edge_force(&SawParameters::cutting_edge, {.id = "cutting_edge",
                                                      .help = "Tooth: edge force against its motion, per width of cut.",
                                                      .max = 500.0_N_per_mm,
                                                      .def = 5.0_N_per_mm,
                                                      .source = single_tooth}),
            chip_force(&SawParameters::cutting_chip, "cutting_chip", "Tooth: force against its motion, per chip area.",
                       0.0, "the cutting force is constant from 2 to 10 um [james-2013]"),
            edge_depth_of(&SawParameters::edge_depth, 0.01_um, 20.0_um, 0.4_um,
                          "assumed: the largest that leaves the published checks unchanged"),
            param(&SawParameters::set_share,
                  {.id = "set_share",
                   .help = "Force of a tooth to the side it is set to, as a fraction of its thrust.",
                   .min = 0.0,
                   .max = 1.0,
                   .def = 0.1,
                   .source = "assumed; neighbours cancel"}),
            reference_density_of(&SawParameters::reference_density),
            contact_stiffness_of(&SawParameters::contact_stiffness,
                                 "Stiffness of bone at each point where a side or the still teeth touch."),
            steel_friction(&SawParameters::friction),
            effect(&SawParameters::thrust_edge, {.id = "edge_term", .help = "Teeth resist also at almost no feed."}),
            effect(&SawParameters::cutting_edge, {.id = "edge_term", .help = "Teeth resist also at almost no feed."}),
            effect(&SawParameters::set_share,
                   {.id = "set_force", .help = "A tooth without a neighbour pushes the blade aside."}),
            effect(&SawParameters::friction, {.id = "friction", .help = "The sides rub where the blade binds."}));
    }
};

}  // namespace kerf::sawing
