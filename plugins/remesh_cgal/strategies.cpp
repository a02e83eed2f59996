// SPDX-License-Identifier: GPL-3.0-or-later
#include "strategies.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "booleans.h"

namespace kerf::remesh_cgal {
namespace {

using Cut = std::function<Outcome(Triangles&, const std::vector<ConvexPart>&, const Cancelled&, std::string&)>;

/// Cuts the job's mesh with the sweeps of its tools.
RemeshAnswer answer(const RemeshJob& job, const Cut& cut_mesh) {
    std::vector<ConvexPart> parts;
    const Nudge nudge = Nudge::of(job.seed());
    for (const SweptTool& cut : job.cuts()) {
        if (cut.bore > 0.0) return RemeshAnswer::declined("the tool is hollow");
        for (ConvexPart& part : swept_parts({cut.profile, cut.kerf}, cut.from, cut.to, job.tolerance(), nudge))
            parts.push_back(std::move(part));
    }
    Triangles mesh = job.mesh();
    std::string why;
    const Outcome outcome = cut_mesh(mesh, parts, job.cancelled(), why);
    return RemeshAnswer::of(outcome, std::move(mesh), std::move(why));
}

}  // namespace

RemeshAnswer Exact::remesh(const RemeshJob& job) const { return answer(job, cut_whole); }

RemeshAnswer Local::remesh(const RemeshJob& job) const {
    const bool is_exact = job.seed() != 0;
    return answer(job, [is_exact](Triangles& mesh, const std::vector<ConvexPart>& parts, const Cancelled& cancelled,
                                  std::string& why) { return cut_patch(mesh, parts, is_exact, cancelled, why); });
}

RemeshAnswer WholeRounded::remesh(const RemeshJob& job) const { return answer(job, cut_whole_rounded); }

}  // namespace kerf::remesh_cgal
