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

inline ToolSetup saw(const std::map<std::string, double>& set = {}) {
    return powered_tool("kerf.sawing", "oscillating_blade", "saw_cutting", set);
}
inline ToolSetup reciprocating_saw(const std::map<std::string, double>& set = {}) {
    return powered_tool("kerf.sawing", "reciprocating_blade", "reciprocating_cutting", set);
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
