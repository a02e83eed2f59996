// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "tests/support/drill_rig.h"

/// The sawing plugin as the host loads it. The bone's face is z = 0; the saw comes from above and feeds along −z, its
/// teeth go along x, and y is across the blade.
namespace kerf::test {

/// The motor follows at once unless `set` says otherwise: most questions are about the law at speed.
inline ToolSetup saw_of(const std::string& tool, const std::string& force, std::map<std::string, double> set) {
    set.insert({"run_up", 0.0});
    ToolSetup setup;
    setup.tool = plugins().find("kerf.sawing", KERF_KIND_TOOL, tool);
    setup.force = plugins().find("kerf.sawing", KERF_KIND_FORCE, force);
    if (setup.tool == nullptr || setup.force == nullptr) throw std::runtime_error("no sawing plugin in lib/kerf");
    for (const auto& info : plugins().catalog()) {
        if (info.plugin != "kerf.sawing") continue;
        if (info.id == tool) {
            setup.tool_parameters = values(info.parameters, set);
            setup.drives = values(info.drives, set);
        }
        if (info.id == force) setup.force_parameters = values(info.parameters, set);
    }
    return setup;
}
inline ToolSetup saw(const std::map<std::string, double>& set = {}) {
    return saw_of("oscillating_blade", "saw_cutting", set);
}
inline ToolSetup reciprocating_saw(const std::map<std::string, double>& set = {}) {
    return saw_of("reciprocating_blade", "reciprocating_cutting", set);
}

/// A tube along y, ends at ± half a length: a shaft of bone, sawn across.
inline Body tube(double outer, double inner, double half_length, double spacing, Vec3 offset = {0.31, 0.17, 0.73}) {
    const double margin = 6.0 * spacing;
    const Vec3 high{outer + margin, half_length + margin, outer + margin};
    Grid grid = Grid::covering(-high, high, spacing);
    grid.origin = grid.origin + spacing * offset;
    Body body;
    body.id = "tube";
    body.surface = LevelSet::build(grid, [=](Vec3 p) {
        const double r = std::hypot(p.x, p.z);
        return std::max({r - outer, inner - r, std::abs(p.y) - half_length});
    });
    body.materials.push_back({"cortical", 1850.0, {}});
    return body;
}

}  // namespace kerf::test
