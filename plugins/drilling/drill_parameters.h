// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/cutter_parameters.hpp"
#include "kerf/edge_law.hpp"
#include "kerf/force.hpp"

/// Parameters of a drill's law: coefficients of bone and edges.
namespace kerf::drilling {

/// Coefficients of lips and chisel edge.
struct EdgeSet {
    EdgeCoefficients thrust, cutting, chisel;
};

/// The parameters of the law, SI.
struct DrillParameters {
    double thrust_edge, thrust_chip, cutting_edge, cutting_chip, chisel_edge, chisel_chip, edge_depth;
    double reference_density, element_pitch, rake_effect, relief_angle, heel_stiffness, contact_stiffness, clearance,
        friction;

    [[nodiscard]] EdgeSet edges() const noexcept {
        return {.thrust = {thrust_edge, edge_depth, thrust_chip},
                .cutting = {cutting_edge, edge_depth, cutting_chip},
                .chisel = {chisel_edge, edge_depth, chisel_chip}};
    }

    // NOLINTNEXTLINE(readability-function-size): a table, one row for each parameter
    static constexpr auto about() {
        using namespace literals;
        constexpr const char* femur_fit = "calibrated: human femur cortex, 3.2 mm, 2 mm/s, least squares over 1000, "
                                          "1250 and 1500 rpm [macavelia-2012]; docs/models/drilling.md";
        return group(
            edge_force(&DrillParameters::thrust_edge, {.id = "thrust_edge",
                                                       .help = "Lip: edge force normal to the cut, per width of cut.",
                                                       .max = 500.0_N_per_mm,
                                                       .def = 27.1630_N_per_mm,
                                                       .source = femur_fit}),
            chip_force(&DrillParameters::thrust_chip, "thrust_chip", "Lip: force normal to the cut, per chip area.",
                       284.767_N_per_mm2, femur_fit),
            edge_force(&DrillParameters::cutting_edge, {.id = "cutting_edge",
                                                        .help = "Lip: edge force along the cut, per width of cut.",
                                                        .max = 500.0_N_per_mm,
                                                        .def = 16.2032_N_per_mm,
                                                        .source = femur_fit}),
            chip_force(&DrillParameters::cutting_chip, "cutting_chip", "Lip: force along the cut, per chip area.",
                       933.650_N_per_mm2, femur_fit),
            edge_force(&DrillParameters::chisel_edge,
                       {.id = "chisel_edge",
                        .help = "Chisel edge: thrust per length.",
                        .max = 1000.0_N_per_mm,
                        .def = 99.1430_N_per_mm,
                        .source = "45 % of the thrust [saha-1982, assumed to hold for edge and chip alike]"}),
            chip_force(&DrillParameters::chisel_chip, "chisel_chip", "Chisel edge: thrust per length and feed per lip.",
                       871.475_N_per_mm2, "45 % of the thrust [saha-1982, assumed to hold for edge and chip alike]"),
            edge_depth_of(&DrillParameters::edge_depth, 0.01_um, 20.0_um, 4.0_um,
                          "assumed: the largest that leaves the published checks unchanged"),
            reference_density_of(&DrillParameters::reference_density),
            param(&DrillParameters::element_pitch,
                  {.id = "element_pitch",
                   .help = "Length of one piece of lip.",
                   .unit = unit::mm,
                   .min = 0.02_mm,
                   .max = 1.0_mm,
                   .def = 0.1_mm,
                   .source = "measured: finer changes thrust by under 0.3 % at 0.2 mm"}),
            param(&DrillParameters::rake_effect,
                  {.id = "rake_effect",
                   .help = "How much less the lips' forces are for each degree more of rake.",
                   .min = 0.0,
                   .max = 0.05,
                   .def = 0.01,
                   .source = "assumed: order known from metal; best rake of bone is not settled [krause-1987]"}),
            param(&DrillParameters::relief_angle, {.id = "relief_angle",
                                                   .help = "Relief behind the lip: faster feeds ride on the heel.",
                                                   .unit = unit::deg,
                                                   .min = 1.0_deg,
                                                   .max = 30.0_deg,
                                                   .def = 10.0_deg,
                                                   .source = "standard grind"}),
            param(&DrillParameters::heel_stiffness, {.id = "heel_stiffness",
                                                     .help = "Stiffness of the heels on bone of the reference density, "
                                                             "for what each lip feeds beyond the relief.",
                                                     .unit = unit::N_per_mm,
                                                     .min = 0.0,
                                                     .max = 10000.0_N_per_mm,
                                                     .def = 1000.0_N_per_mm,
                                                     .source = "assumed"}),
            contact_stiffness_of(&DrillParameters::contact_stiffness,
                                 "Stiffness of bone at each place where the shank or the still tip touches."),
            param(&DrillParameters::clearance, {.id = "clearance",
                                                .help = "How far the shank is thinner than the hole, on the radius.",
                                                .unit = unit::mm,
                                                .min = 0.0,
                                                .max = 1.0_mm,
                                                .def = 0.05_mm,
                                                .source = "assumed"}),
            steel_friction(&DrillParameters::friction),
            resolution(&DrillParameters::element_pitch,
                       {.id = "element_pitch", .help = "How many elements a lip has.", .off = 1.0_mm}),
            effect(&DrillParameters::thrust_edge,
                   {.id = "edge_term", .help = "Edges resist also where they hardly feed."}),
            effect(&DrillParameters::cutting_edge,
                   {.id = "edge_term", .help = "Edges resist also where they hardly feed."}),
            effect(&DrillParameters::chisel_edge,
                   {.id = "edge_term", .help = "Edges resist also where they hardly feed."}),
            effect(&DrillParameters::chisel_edge, {.id = "chisel", .help = "The chisel edge's thrust."}),
            effect(&DrillParameters::chisel_chip, {.id = "chisel", .help = "The chisel edge's thrust."}),
            effect(&DrillParameters::rake_effect,
                   {.id = "rake", .help = "Lips cut easier where their rake is larger."}),
            effect(&DrillParameters::heel_stiffness,
                   {.id = "heel", .help = "Faster feeds than the relief allows ride on the heel."}),
            effect(&DrillParameters::friction, {.id = "friction", .help = "The shank rubs in its hole."}));
    }
};

}  // namespace kerf::drilling
