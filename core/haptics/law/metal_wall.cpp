// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/metal_wall.h"

#include <array>

#include "core/haptics/law/outline_wall.h"

namespace kerf {

bool metal_wall(const LiveBody& body, const ToolOutline& tool, kerf_channel& channel) noexcept {
    constexpr double near_contact = 0.3e-3;  // [m] no channel from this distance on
    const auto all = [](const std::array<Vec3, 8>&) { return true; };
    const auto entered = [](Vec3, const kerf_surface_point& metal) {
        return metal.body < 0 ? Penetration{} : Penetration{-metal.distance, -metal.normal};
    };
    return outline_wall(OwnContact::metal, tool.is_implant() ? tool.staying : tool.cutting, body.view,
                        2.0 * body.bone->grid().spacing, -near_contact, all, entered, channel, tool.is_implant());
}

}  // namespace kerf
