// SPDX-License-Identifier: GPL-3.0-or-later
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "booleans.h"

namespace kerf::remesh_cgal {
namespace {

using remeshing::array, remeshing::read, remeshing::write;

kerf_status refuse(kerf_remesh_out& out, const std::string& why) {
    return remeshing::refuse(KERF_REMESH_REFUSED, out, why);
}

using Cancelled = std::function<bool()>;
using Parts = std::vector<ConvexPart>;
using Cut = Outcome (*)(const kerf_remesh_in&, Triangles&, const Parts&, const Cancelled&, std::string&);

Outcome exact(const kerf_remesh_in&, Triangles& mesh, const Parts& parts, const Cancelled& cancelled,
              std::string& why) {
    return cut_whole(mesh, parts, cancelled, why);
}
/// At first with rounded points, which is fast. What that spoils is cut exactly when the host asks again.
Outcome local(const kerf_remesh_in& in, Triangles& mesh, const Parts& parts, const Cancelled& cancelled,
              std::string& why) {
    return cut_patch(mesh, parts, in.nudge_seed != 0, cancelled, why);
}
Outcome whole_rounded(const kerf_remesh_in&, Triangles& mesh, const Parts& parts, const Cancelled& cancelled,
                      std::string& why) {
    return cut_whole_rounded(mesh, parts, cancelled, why);
}

/// Cuts the request's mesh by what its tools sweep.
template <Cut cut_mesh>
kerf_status remesh(const kerf_remesh_in* in, const kerf_arena* from, kerf_arena* to, kerf_remesh_out* out,
                   void* /*cache*/) {
    try {
        const auto* cancel =
            in->cancel != 0 ? reinterpret_cast<const volatile std::uint32_t*>(from->base + in->cancel) : nullptr;
        const auto solids = array<kerf_cut_solid>(*from, in->solids, in->solid_count);
        std::vector<ConvexPart> parts;
        const Nudge nudge = Nudge::of(in->nudge_seed);
        for (const kerf_cut& cut : array<kerf_cut>(*from, in->cuts, in->cut_count)) {
            const kerf_cut_solid& solid = solids[cut.solid];
            const CutSolid shape{array<kerf_profile_point>(*from, solid.profile, solid.profile_count), solid.kerf};
            for (ConvexPart& part : swept_parts(shape, cut.from, cut.to, in->tolerance, nudge))
                parts.push_back(std::move(part));
        }
        Triangles mesh = read(in->base, *from);
        std::string why;
        switch (cut_mesh(
            *in, mesh, parts, [cancel] { return cancel != nullptr && *cancel != 0; }, why)) {
            case Outcome::cut:
                return write(mesh, *to, out->result) ? KERF_OK : refuse(*out, "the arena has no room for the result");
            case Outcome::unchanged:
                return KERF_REMESH_UNCHANGED;
            case Outcome::cancelled:
                return KERF_REMESH_CANCELLED;
            case Outcome::refused:
                break;
        }
        return refuse(*out, why);
    } catch (const std::exception& e) {
        return refuse(*out, e.what());
    }
}

constexpr kerf_remesher remeshers[] = {
    {sizeof(kerf_remesher), KERF_REMESH_WHOLE, "exact",
     "The whole mesh at once, in exact arithmetic: the reference, and what ends a session.", &remesh<exact>, nullptr,
     nullptr},
    {sizeof(kerf_remesher), KERF_REMESH_PATCH, "local",
     "The faces near each cut, one stretch after the other, with rounded points.", &remesh<local>, nullptr, nullptr},
    {sizeof(kerf_remesher), KERF_REMESH_WHOLE, "whole_rounded",
     "The whole mesh for each stretch, with rounded points: what `local` is measured against.", &remesh<whole_rounded>,
     nullptr, nullptr}};

}  // namespace
}  // namespace kerf::remesh_cgal

extern "C" __attribute__((visibility("default"))) const kerf_remesh_module kerf_remesh_entry;
extern "C" const kerf_remesh_module kerf_remesh_entry = {
    KERF_MAGIC,
    KERF_REMESH_DRAFT,
    sizeof(kerf_remesh_module),
    sizeof kerf::remesh_cgal::remeshers / sizeof kerf::remesh_cgal::remeshers[0],
    KERF_REMESH_SIZES_INIT,
    "kerf.remesh_cgal",
    "0.1.0",
    "GPL-3.0-or-later",
    kerf::remesh_cgal::kernel(),
    kerf::remesh_cgal::remeshers};
