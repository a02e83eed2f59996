// SPDX-License-Identifier: Apache-2.0
#include "run/view/bone_slice.h"

#include <algorithm>
#include <cstddef>

namespace kerf::run {

namespace {

constexpr std::int8_t no_tissue = -1, metal = -2;

/// Returns whether a body can come into the slice.
bool is_near(const LiveBody& live, const Pose& body_from_slice, const ViewedSlice& slice) {
    const Vec3 middle = body_from_slice.position;
    const double half = 0.75 * slice.step * slice.edge;  // more than half of the diagonal
    const Vec3 around{half, half, half};
    return live.is_near_box(middle - around, middle + around, slice.reach);
}

void add_body(const LiveBody& live, const Pose& body_from_slice, ViewedSlice& slice) {
    const Body& bone = *live.bone;
    std::size_t at = 0;
    for (int row = 0; row < slice.edge; ++row)
        for (int column = 0; column < slice.edge; ++column, ++at) {
            const LocatedPoint place = locate(bone, body_from_slice * slice.point(column, row));
            const double distance = std::max(bone.surface.at(place), live.committed.at(place));
            if (!live.is_cuttable) {
                if (distance < 0.0) slice.tissue[at] = metal;
                continue;
            }
            if (distance >= static_cast<double>(slice.distance[at])) continue;
            slice.distance[at] = static_cast<float>(distance);
            if (distance >= 0.0 || slice.tissue[at] == metal) continue;
            double weight[KERF_MAX_TISSUES];
            material_weights(bone, place, weight);
            slice.tissue[at] =
                static_cast<std::int8_t>(std::max_element(weight, weight + bone.materials.size()) - weight);
        }
}

}  // namespace

ViewedSlice bone_slice(const Simulation& simulation, const Pose& tool_from_slice, double step, int edge) {
    ViewedSlice slice{.world_from_slice = simulation.world_from_tool() * tool_from_slice,
                      .tool_from_slice = tool_from_slice,
                      .step = step,
                      .edge = edge,
                      .reach = simulation.bodies().front()->bone->grid().clamp()};
    const auto samples = static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge);
    slice.distance.assign(samples, static_cast<float>(slice.reach));
    slice.tissue.assign(samples, no_tissue);
    for (const auto& live : simulation.bodies()) {
        const Pose body_from_slice = inverse(live->world_from_body) * slice.world_from_slice;
        if (live->is_present && is_near(*live, body_from_slice, slice)) add_body(*live, body_from_slice, slice);
    }
    return slice;
}

}  // namespace kerf::run
