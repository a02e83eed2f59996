// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/describe.hpp"
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
            param(&BurrParameters::thrust_edge, {.id = "thrust_edge",
                                                 .help = "Blade: edge force normal to the head, per width of cut.",
                                                 .unit = unit::N_per_mm,
                                                 .min = 0.0,
                                                 .max = 100.0_N_per_mm,
                                                 .def = 1.0_N_per_mm,
                                                 .source = normal}),
            param(&BurrParameters::thrust_chip, {.id = "thrust_chip",
                                                 .help = "Blade: force normal to the head, per chip area.",
                                                 .unit = unit::N_per_mm2,
                                                 .min = 0.0,
                                                 .max = 10000.0_N_per_mm2,
                                                 .def = 1300.0_N_per_mm2,
                                                 .source = normal}),
            param(&BurrParameters::cutting_edge, {.id = "cutting_edge",
                                                  .help = "Blade: edge force against the turn, per width of cut.",
                                                  .unit = unit::N_per_mm,
                                                  .min = 0.0,
                                                  .max = 100.0_N_per_mm,
                                                  .def = 0.7_N_per_mm,
                                                  .source = no_force}),
            param(&BurrParameters::cutting_chip, {.id = "cutting_chip",
                                                  .help = "Blade: force against the turn, per chip area.",
                                                  .unit = unit::N_per_mm2,
                                                  .min = 0.0,
                                                  .max = 10000.0_N_per_mm2,
                                                  .def = 934.0_N_per_mm2,
                                                  .source = "assumed: that of a drill's lip [macavelia-2012]"}),
            param(&BurrParameters::edge_depth,
                  {.id = "edge_depth",
                   .help = "Chip thickness at which the edge force has built up.",
                   .unit = unit::um,
                   .min = 0.001_um,
                   .max = 5.0_um,
                   .def = 0.02_um,
                   .source = "assumed: so small that the feed hardly counts, as measured [danda-2016]"}),
            param(&BurrParameters::reference_density, {.id = "reference_density",
                                                       .help = "Density of the bone that the coefficients belong to.",
                                                       .unit = unit::g_per_cm3,
                                                       .min = 0.5_g_per_cm3,
                                                       .max = 2.5_g_per_cm3,
                                                       .def = 1.85_g_per_cm3,
                                                       .source = "assumed: middle of the cortical range"}),
            param(&BurrParameters::contact_stiffness,
                  {.id = "contact_stiffness",
                   .help = "Stiffness of bone at each part of the head or the neck that touches without cutting.",
                   .unit = unit::N_per_mm,
                   .min = 1.0_N_per_mm,
                   .max = 10000.0_N_per_mm,
                   .def = 500.0_N_per_mm,
                   .source = "assumed"}),
            param(&BurrParameters::friction, {.id = "friction",
                                              .help = "Friction of steel on wet bone.",
                                              .min = 0.0,
                                              .max = 1.5,
                                              .def = 0.3,
                                              .source = "0.3 [mandibular-angle]"}),
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
