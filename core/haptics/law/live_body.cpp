// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/live_body.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace kerf {

LiveBody::LiveBody(std::uint16_t number, const Body& of_bone, CutField field, const ToolSolid& solid)
    : id(number),
      bone(&of_bone),
      committed(std::move(field)),
      tracker(of_bone, solid, committed),
      view(of_bone, committed, tracker),
      group(number) {
    tracker.name(number);
    view.name(number);
    find_box();
}

void LiveBody::find_box() {
    const Grid& g = bone->grid();
    std::array<int, 3> first{g.bricks[0], g.bricks[1], g.bricks[2]}, last{-1, -1, -1};
    for (std::size_t b = 0; b < g.brick_count(); ++b) {
        if (bone->surface.is_all_air(b) || committed.is_removed(b)) continue;
        const auto at = g.brick_coordinates(b);
        for (std::size_t a = 0; a < 3; ++a) {
            first[a] = std::min(first[a], at[a]);
            last[a] = std::max(last[a], at[a]);
        }
    }
    low = g.sample_position(first[0] * brick_edge, first[1] * brick_edge, first[2] * brick_edge);
    high = g.sample_position((last[0] + 1) * brick_edge, (last[1] + 1) * brick_edge, (last[2] + 1) * brick_edge);
    if (!bone->region.is_bounded()) return;
    // Bone that reaches a face of the region continues beyond it.
    constexpr double far = 1.0;  // [m]
    const auto reach = [&](double& l, double& h, double face_low, double face_high) {
        if (l <= face_low) l -= far;
        if (h >= face_high) h += far;
    };
    reach(low.x, high.x, bone->region.low.x, bone->region.high.x);
    reach(low.y, high.y, bone->region.low.y, bone->region.high.y);
    reach(low.z, high.z, bone->region.low.z, bone->region.high.z);
}

bool LiveBody::is_near_box(Vec3 box_low, Vec3 box_high, double margin) const noexcept {
    const auto meets = [&](double l, double h, double bone_l, double bone_h) {
        return l - margin <= bone_h && h + margin >= bone_l;
    };
    return meets(box_low.x, box_high.x, low.x, high.x) && meets(box_low.y, box_high.y, low.y, high.y) &&
           meets(box_low.z, box_high.z, low.z, high.z);
}

std::unique_ptr<LiveBody> live_body(std::uint16_t number, const Body& of_bone, const CutField& cut,
                                    const ToolSolid& solid) {
    CutField field = cut;
    field.reserve(live_reserve);
    return std::make_unique<LiveBody>(number, of_bone, std::move(field), solid);
}

}  // namespace kerf
