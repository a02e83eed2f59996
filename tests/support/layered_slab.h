// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"

/// The layered slab of scene C.9, and the exact thrust of the drill's own law in it.
namespace kerf::test {

/// 4 mm cortical, 10 mm cancellous (a tenth of the force), 4 mm cortical, then air. Its upper face is z = 0.
struct Slab {
    static constexpr double first = 4e-3, second = 14e-3, third = 18e-3;  // [m]
    static double resistance(double depth) {
        if (depth <= 0.0 || depth >= third) return 0.0;
        return depth > first && depth < second ? 0.1 : 1.0;
    }
    static Body make(double h, Vec3 offset) {
        Body body = block({-8e-3, -6e-3, -third}, {8e-3, 6e-3, 0}, h, offset);
        body.materials.clear();
        const LevelSet middle = LevelSet::build(
            body.grid(), [](Vec3 p) { return std::abs(p.z + 0.5 * (first + second)) - 0.5 * (second - first); });
        body.materials.push_back({"cancellous", 1850.0 * std::sqrt(0.1), middle});
        body.materials.push_back({"cortical", 1850.0, {}});
        return body;
    }
};

/// The lip integral of the same law, piece by piece, chisel included [N]: the drill at `pose`, its first lip at `angle`
/// [rad], `feed_per_lip` [m]. Every edge is at its front. `pieces` per lip: midpoint rule.
inline double exact_thrust(const ToolSetup& setup, const Pose& pose, double angle, double feed_per_lip, int pieces) {
    using namespace drilling;
    const TwistDrill drill = value_of<drilling::TwistBit>(setup.tool_parameters).drill();
    const auto [lip, cutting, chisel] = value_of<DrillCutting>(setup.force_parameters).edges();
    const double p = 0.5 * drill.point_angle, b = drill.half_web(), r_c = drill.chisel_radius(), r_o = drill.radius();
    const double first = std::sqrt(r_c * r_c - b * b), last = std::sqrt(r_o * r_o - b * b);
    const double c = std::cos(angle), s = std::sin(angle);
    const auto resistance_at = [&](double x, double y, double r) {
        return Slab::resistance(-(pose * Vec3{x, y, -r / std::tan(p)}).z);
    };
    double thrust = 0.0;
    for (int i = 0; i < pieces; ++i) {
        const double along = first + (i + 0.5) * (last - first) / pieces;
        const double r = std::hypot(along, b), cos_beta = along / r;
        const double cos_i = std::sqrt(std::cos(p) * std::cos(p) + std::sin(p) * std::sin(p) * cos_beta * cos_beta);
        const double n_z = std::sin(p) * cos_beta / cos_i, width = (last - first) / pieces / std::sin(p) * cos_i;
        const double x = along * c - b * s, y = along * s + b * c;
        thrust += (resistance_at(x, y, r) + resistance_at(-x, -y, r)) * width * n_z *
                  force_per_width(feed_per_lip * n_z, lip);
        const double r_chisel = (i + 0.5) * r_c / pieces;
        thrust += (resistance_at(-r_chisel * s, r_chisel * c, r_chisel) +
                   resistance_at(r_chisel * s, -r_chisel * c, r_chisel)) *
                  r_c / pieces * force_per_width(feed_per_lip, chisel);
    }
    return thrust;
}

}  // namespace kerf::test
