// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/metal_wall.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kerf/force.hpp"

namespace kerf {

namespace {
constexpr double stiffness = 1e6;      // [N/m], of metal on metal [assumed]
constexpr double near_contact = 0.3e-3;  // [m] farther away there is no channel
constexpr double most_steps = 64.0;      // along one stretch of the outline
}  // namespace

bool metal_wall(const LiveBody& body, const ToolSolid& cutting, kerf_channel& channel) noexcept {
    double deepest = -near_contact;
    Vec3 at{}, outwards{};
    const auto look_at = [&](const std::array<Vec3, 8>& around) {
        std::array<kerf_surface_point, 8> answers;
        body.view.nearest(around.data(), static_cast<std::uint32_t>(around.size()), answers.data());
        for (std::size_t i = 0; i < around.size(); ++i) {
            if (answers[i].body < 0 || answers[i].normal == Vec3{} || -answers[i].distance <= deepest) continue;
            deepest = -answers[i].distance;
            at = around[i];
            outwards = answers[i].normal;
        }
    };
    const auto& outline = cutting.outline();
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const double dz = outline[i + 1].z - outline[i].z, dr = outline[i + 1].radius - outline[i].radius;
        const int steps = static_cast<int>(std::clamp(std::ceil(std::hypot(dz, dr) / (2.0 * body.bone->grid().spacing)), 1.0, most_steps));
        for (int step = i == 0 ? 0 : 1; step <= steps; ++step) {
            const double t = static_cast<double>(step) / steps;
            look_at(cutting.around(outline[i].radius + t * dr, outline[i].z + t * dz));
        }
    }
    if (outwards == Vec3{}) return false;
    channel = kerf_channel{};
    channel.kind = KERF_CONTACT;
    channel.id = 0xfffffffeu;
    const Vec6 d = rate_at(at, -outwards);
    std::copy(d.begin(), d.end(), channel.d);
    channel.w = 1e-6;
    channel.k = stiffness;
    channel.delta = deepest;
    return true;
}

}  // namespace kerf
