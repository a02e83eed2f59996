// SPDX-License-Identifier: Apache-2.0
#include "core/remesh/local_cutting.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/import/surface/surface_mesh.h"
#include "core/remesh/accept.h"

namespace kerf {

Box swept_box(const ToolSolid& solid, const CutStretch& stretch) {
    // Polygons of the same area stand out of a circle, by 1.3 % of its radius where they have 16 sides.
    const double margin = 0.014 * solid.largest_radius() + 1e-5;
    const ToolSolid::Box from = solid.box(stretch.from), to = solid.box(stretch.to);
    const Vec3 more{margin, margin, margin};
    return {Vec3{std::min(from.low.x, to.low.x), std::min(from.low.y, to.low.y), std::min(from.low.z, to.low.z)} - more,
            Vec3{std::max(from.high.x, to.high.x), std::max(from.high.y, to.high.y), std::max(from.high.z, to.high.z)} +
                more};
}

bool LocalCutting::cut(const CutStretch& stretch) {
    const Box box = swept_box(*solids_[stretch.solid], stretch);
    const SurfacePatch patch = surface_.patch_in(box);
    if (patch.faces.empty()) return true;
    RemeshRequest request;
    request.base = patch.mesh;
    request.locked = patch.locked;
    request.cuts = {{stretch.from, stretch.to, 0}};
    request.solids = {solids_[stretch.solid]};
    request.mode = KERF_REMESH_COMMIT;
    request.tolerance = tolerance_;
    std::string why;
    for (int n = 0; n <= most_refusals; ++n) {
        request.nudge_seed = static_cast<std::uint64_t>(n);
        const RemeshResult result = ask_(request);
        if (result.status == KERF_REMESH_UNCHANGED) return true;
        why = result.status == KERF_OK ? flaw_of_patch(request, result.mesh, surface_.ring_of(patch)) : result.message;
        if (result.status == KERF_OK && why.empty()) {
            removed_ += volume_between(result.mesh.mesh, request.base.mesh);
            surface_.replace(patch, result.mesh);
            return true;
        }
        ++refusals_;
        if (result.status != KERF_REMESH_CANCELLED) continue;
        why = "the strategy did not end within its time";
        break;
    }
    stale_.push_back({box, std::move(why)});
    return false;
}

}  // namespace kerf
