// SPDX-License-Identifier: Apache-2.0
#include "core/remesh/local_cutting.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/import/surface/surface_mesh.h"
#include "core/remesh/accept.h"

namespace kerf {

LocalCutting::Attempt LocalCutting::attempt(const AskStrategy& ask, const RemeshRequest& request,
                                            const SurfacePatch& patch, std::string& why) {
    const RemeshResult result = ask(request);
    if (result.status == KERF_REMESH_UNCHANGED) return Attempt::done;
    why = result.status == KERF_OK ? flaw_of_patch(request, result.mesh, surface_.ring_of(patch)) : result.message;
    if (result.status == KERF_OK && why.empty()) {
        removed_ += volume_between(result.mesh.mesh, request.base.mesh);
        surface_.replace(patch, result.mesh);
        return Attempt::done;
    }
    if (result.status != KERF_REMESH_DECLINED) ++refusals_;
    if (result.status == KERF_REMESH_CANCELLED) why = "the strategy did not end within its time";
    return result.status == KERF_REMESH_CANCELLED || result.status == KERF_REMESH_DECLINED ? Attempt::ended
                                                                                           : Attempt::refused;
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
    if (otherwise_) {
        if (attempt(ask_, request, patch, why) == Attempt::done) return true;
        ++handed_over_;
        why_handed_over_ = why;
    }
    const AskStrategy& ask = otherwise_ ? otherwise_ : ask_;
    for (int n = 0; n <= most_refusals; ++n) {
        request.nudge_seed = static_cast<std::uint64_t>(n);
        const Attempt made = attempt(ask, request, patch, why);
        if (made == Attempt::done) return true;
        if (made == Attempt::ended) break;
    }
    stale_.push_back({box, std::move(why)});
    return false;
}

void LocalCutting::give_up(const Box& box, std::string why) {
    if (!surface_.patch_in(box).faces.empty()) stale_.push_back({box, std::move(why)});
}

void LocalCutting::go_back(const Moment& moment) {
    surface_.go_back(moment.surface);
    removed_ = moment.removed;
    refusals_ = moment.refusals;
    handed_over_ = moment.handed_over;
    stale_ = moment.stale;
}

}  // namespace kerf
