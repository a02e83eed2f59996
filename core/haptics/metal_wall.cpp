// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/metal_wall.h"

#include <array>

#include "core/haptics/channel.h"
#include "kerf/force.hpp"

namespace kerf {

namespace {
constexpr double stiffness = 1e6;        // [N/m], of metal on metal [assumed]
constexpr double near_contact = 0.3e-3;  // [m] farther away there is no channel
}  // namespace

bool metal_wall(const LiveBody& body, const ToolSolid& cutting, kerf_channel& channel) noexcept {
    double deepest = -near_contact;
    Vec3 at{}, outwards{};
    cutting.for_each_ring(2.0 * body.bone->grid().spacing, [&](const std::array<Vec3, 8>& ring) {
        std::array<kerf_surface_point, 8> answers;
        body.view.nearest(ring.data(), static_cast<std::uint32_t>(ring.size()), answers.data());
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (answers[i].body < 0 || answers[i].normal == Vec3{} || -answers[i].distance <= deepest) continue;
            deepest = -answers[i].distance;
            at = ring[i];
            outwards = answers[i].normal;
        }
    });
    if (outwards == Vec3{}) return false;
    channel = contact_channel(OwnContact::metal, rate_at(at, -outwards), stiffness, deepest);
    return true;
}

}  // namespace kerf
