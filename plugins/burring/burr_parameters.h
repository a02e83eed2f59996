// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/cutter_parameters.hpp"
#include "kerf/edge_law.hpp"

/// Parameters of a burr's law: coefficients of bone and blades.
namespace kerf::burring {

/// The parameters of the law, SI.
struct BurrParameters {
    double thrust_edge, thrust_chip, cutting_edge, cutting_chip, edge_depth;
    double reference_density, contact_stiffness, friction, edge_points;

    [[nodiscard]] EdgeCoefficients thrust() const noexcept { return {thrust_edge, edge_depth, thrust_chip}; }
    [[nodiscard]] EdgeCoefficients cutting() const noexcept { return {cutting_edge, edge_depth, cutting_chip}; }

    static constexpr auto about() {
        using namespace literals;
        constexpr const char* no_force = "assumed: a groove 1 mm deep then takes a few newtons; no measured force of a "
                                         "burr has been found in numbers";
        constexpr const char* normal = "assumed: 1.4 times that against the turn, as of a saw's tooth [saw-thesis]";
        return group(
            edge_force(&BurrParameters::thrust_edge, {.id = "thrust_edge",
                                                      .help = "Blade: edge force normal to the head, per width of cut.",
                                                      .max = 100.0_N_per_mm,
                                                      .def = 1.0_N_per_mm,
                                                      .source = normal}),
            chip_force(&BurrParameters::thrust_chip, "thrust_chip", "Blade: force normal to the head, per chip area.",
                       1300.0_N_per_mm2, normal),
            edge_force(&BurrParameters::cutting_edge, {.id = "cutting_edge",
                                                       .help = "Blade: edge force against the turn, per width of cut.",
                                                       .max = 100.0_N_per_mm,
                                                       .def = 0.7_N_per_mm,
                                                       .source = no_force}),
            chip_force(&BurrParameters::cutting_chip, "cutting_chip", "Blade: force against the turn, per chip area.",
                       934.0_N_per_mm2, "assumed: that of a drill's lip [macavelia-2012]"),
            edge_depth_of(&BurrParameters::edge_depth, 0.001_um, 5.0_um, 0.02_um,
                          "assumed: so small that the feed hardly counts, as measured [danda-2016]"),
            reference_density_of(&BurrParameters::reference_density,
                                 "Density of the bone that the coefficients belong to."),
            contact_stiffness_of(
                &BurrParameters::contact_stiffness,
                "Stiffness of bone at each part of the head or the neck that touches without cutting."),
            steel_friction(&BurrParameters::friction, "0.3 [mandibular-angle]"),
            param(&BurrParameters::edge_points, {.id = "edge_points",
                                                 .help = "Points of the head at which the bone is sampled, rounded "
                                                         "down to a multiple of 12.",
                                                 .min = 24.0,
                                                 .max = 336.0,
                                                 .def = 84.0,
                                                 .source = "with those of the neck fewer than 110 [mandibular-angle]"}),
            effect(&BurrParameters::thrust_edge, {.id = "edge_term", .help = "Blades resist also at almost no feed."}),
            effect(&BurrParameters::cutting_edge, {.id = "edge_term", .help = "Blades resist also at almost no feed."}),
            effect(&BurrParameters::friction, {.id = "friction", .help = "Neck and still head rub where they touch."}));
    }
};

}  // namespace kerf::burring
