// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plugin/component_info.h"
#include "kerf/units.hpp"

/// What the drilling plugin offers, as far as these tests need it.
namespace kerf::documents {

inline ComponentCatalog drilling_catalog() {
    using namespace literals;
    ComponentInfo tool;
    tool.plugin = "kerf.drilling";
    tool.id = "twist_drill";
    tool.kind = KERF_KIND_TOOL;
    tool.parameters = {{"diameter", "", dimension::length, "mm", 0.5_mm, 20.0_mm, 3.2_mm, ""},
                       {"point_angle", "", dimension::angle, "deg", 60.0_deg, 160.0_deg, 118.0_deg, ""}};
    tool.drives = {{"spindle_speed", "", dimension::frequency, "rpm", 0.0_rpm, 3000.0_rpm, 0.0_rpm, ""}};
    ComponentInfo force;
    force.plugin = "kerf.drilling";
    force.id = "drill_cutting";
    force.kind = KERF_KIND_FORCE;
    force.parameters = {{"wear", "", dimension::none, "", 0.0, 1.0, 0.25, ""}};
    force.signals = {{"spindle_speed", "", dimension::frequency, "rpm"},
                     {"drive_power", "", dimension::power, "W"},
                     {"engagement", "", dimension::none, ""}};
    force.events = {{"drilling.bit_overbent", "The bit was bent.", true},
                    {"drilling.stalled", "The spindle was held fast.", false}};
    return {tool, force};
}

/// What the shipped procedures for the spine use.
inline ComponentCatalog spine_catalog() {
    using namespace literals;
    ComponentCatalog catalog = drilling_catalog();
    ComponentInfo tool;
    tool.plugin = "kerf.implant";
    tool.id = "pedicle_screw";
    tool.kind = KERF_KIND_TOOL;
    tool.parameters = {{"outer_diameter", "", dimension::length, "mm", 2.0_mm, 10.0_mm, 6.5_mm, ""},
                       {"core_diameter", "", dimension::length, "mm", 0.5_mm, 9.0_mm, 4.25_mm, ""},
                       {"thread_length", "", dimension::length, "mm", 5.0_mm, 90.0_mm, 45.0_mm, ""}};
    ComponentInfo force;
    force.plugin = tool.plugin;
    force.id = "screw_insertion";
    force.kind = KERF_KIND_FORCE;
    force.signals = {{"torque", "", dimension::torque, "N m"},
                     {"clamp", "", dimension::force, "N"},
                     {"engaged", "", dimension::length, "mm"}};
    force.events = {{"implant.head_contact", "", false}, {"implant.stripped", "", true}};
    catalog.push_back(tool);
    tool.id = "tap";
    catalog.push_back(tool);
    catalog.push_back(force);
    return catalog;
}

/// What drilling offers, from the plugin that the shapes' examples speak of: core knows none by name.
inline ComponentCatalog example_catalog() {
    ComponentCatalog catalog = drilling_catalog();
    ComponentInfo strategy;
    strategy.id = "groove";
    strategy.kind = KERF_KIND_REMESHER;
    strategy.help = "Cuts grooves.";
    strategy.parameters.push_back({.id = "tolerance",
                                   .help = "How far its surface may be off.",
                                   .dimension = dimension::length,
                                   .display_unit = "um",
                                   .min = 1e-6,
                                   .max = 1e-3,
                                   .def = 20e-6,
                                   .source = "chosen"});
    catalog.push_back(strategy);
    for (ComponentInfo& component : catalog) component.plugin = "example.drilling";
    return catalog;
}

}  // namespace kerf::documents
