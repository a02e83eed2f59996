// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/local_cutting.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "bone/remesh/accept.h"
#include "bone/remesh/removal.h"
#include "bone/surface/surface_mesh.h"

namespace kerf::bone {

LocalCutting::LocalCutting(const TaggedMesh& mesh, std::vector<const ToolSolid*> solids, double tolerance,
                           StrategyCall call, StrategyCall otherwise)
    : LocalCutting(mesh, std::move(solids), tolerance, std::vector<std::vector<NamedStrategy>>{}) {
    std::vector<NamedStrategy> all{{"first", std::move(call)}};
    if (otherwise) all.push_back({"second", std::move(otherwise)});
    strategies_.assign(solids_.size(), all);
}

LocalCutting::Attempt LocalCutting::attempt(const NamedStrategy& strategy, const RemeshRequest& request,
                                            const SurfacePatch& patch, std::string& why) {
    const RemeshResult result = strategy.call(request);
    const double allowed = allowed_for(request, strategy.tolerance);
    const bool is_unchanged = result.status == KERF_REMESH_UNCHANGED;
    why = is_unchanged               ? flaw_of_unchanged(request, allowed)
          : result.status == KERF_OK ? flaw_of_patch(request, result.mesh, surface_.ring_of(patch))
                                     : result.message;
    if (result.status == KERF_OK && why.empty()) why = flaw_of_removal(request, result.mesh, allowed);
    if (is_unchanged && why.empty()) return Attempt::done;
    if (result.status == KERF_OK && why.empty()) {
        removed_ += volume_between(result.mesh.mesh, request.base.mesh);
        surface_.replace(patch, result.mesh);
        return Attempt::done;
    }
    const bool is_declined = result.status == KERF_REMESH_DECLINED;
    if (!is_declined) ++refusals_;
    (is_declined ? declined_ : refused_)[strategy.id].add(why);
    return result.status == KERF_REMESH_CANCELLED || result.status == KERF_REMESH_DECLINED ? Attempt::ended
                                                                                           : Attempt::refused;
}

bool LocalCutting::cut(const CutStretch& stretch, std::string& why) {
    const SurfacePatch patch = surface_.patch_in(swept_box(*solids_[stretch.solid], stretch));
    if (patch.faces.empty()) return true;
    RemeshRequest request;
    request.base = patch.mesh;
    request.locked = patch.locked;
    request.cuts = {{stretch.from, stretch.to, 0}};
    request.solids = {solids_[stretch.solid]};
    request.mode = KERF_REMESH_COMMIT;
    request.tolerance = tolerance_;
    const std::vector<NamedStrategy>& strategies = strategies_[stretch.solid];
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        const bool is_last = s + 1 == strategies.size();
        for (int n = 0; n <= (is_last ? max_refusals : 0); ++n) {
            request.nudge_seed = static_cast<std::uint64_t>(n);
            const Attempt made = attempt(strategies[s], request, patch, why);
            if (made == Attempt::done) return true;
            if (made == Attempt::ended) break;
        }
        if (is_last) break;
        ++handed_over_;
        hand_over_reason_ = why;
    }
    return false;
}

bool LocalCutting::cut(const CutStretch& stretch) {
    std::string why;
    if (cut(stretch, why)) return true;
    stale_.push_back({swept_box(*solids_[stretch.solid], stretch), std::move(why)});
    return false;
}

void LocalCutting::mark_stale(const Box& box, std::string why) {
    if (!surface_.patch_in(box).faces.empty()) stale_.push_back({box, std::move(why)});
}

void LocalCutting::restore(const Moment& moment) {
    surface_.restore(moment.surface);
    removed_ = moment.removed;
    refusals_ = moment.refusals;
    handed_over_ = moment.handed_over;
    refused_ = moment.refused;
    declined_ = moment.declined;
    stale_ = moment.stale;
}

}  // namespace kerf::bone
