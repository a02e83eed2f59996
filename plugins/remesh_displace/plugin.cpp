// SPDX-License-Identifier: Apache-2.0
#include <OpenMesh/Core/System/config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "displace.h"
#include "kerf/draft/remesh_solids.hpp"

namespace kerf::remesh_displace {
namespace {

using remeshing::array, remeshing::convex_runs, remeshing::read, remeshing::refuse, remeshing::write;

/// Of the tolerance that a face may be off the burr. All faces lie on one side of it, so their errors add up.
constexpr double wall_share = 0.25;

/// What prevents any work with a request; empty if nothing does.
std::string flaw_of(const Triangles& mesh, const kerf_remesh_in& in) {
    if (mesh.tags.empty()) return "the mesh has no faces";
    if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](Vec3 v) { return is_finite(v); }))
        return "a vertex of the mesh is no number";
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        const std::uint32_t *t = &mesh.triangles[3 * f], count = static_cast<std::uint32_t>(mesh.vertices.size());
        if (t[0] >= count || t[1] >= count || t[2] >= count)
            return "face " + std::to_string(f) + " has a vertex that does not exist";
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "face " + std::to_string(f) + " has a vertex twice";
    }
    if (!(in.tolerance > 0.0) || !std::isfinite(in.tolerance)) return "the tolerance is no length";
    return {};
}

kerf_status displace_all(const kerf_remesh_in* in, const kerf_arena* from, kerf_arena* to, kerf_remesh_out* out,
                         void* /*cache*/) {
    try {
        const auto* cancel =
            in->cancel != 0 ? reinterpret_cast<const volatile std::uint32_t*>(from->base + in->cancel) : nullptr;
        const auto cancelled = [cancel] { return cancel != nullptr && *cancel != 0; };
        Triangles mesh = read(in->base, *from);
        std::string why = flaw_of(mesh, *in);
        if (!why.empty()) return refuse(KERF_REMESH_REFUSED, *out, why);
        const auto flags =
            array<std::uint8_t>(*from, in->base.locked, in->base.locked != 0 ? in->base.vertex_count : 0);
        std::vector<Vec3> locked;  // vertices are renumbered by each cut
        for (std::size_t v = 0; v < flags.size(); ++v)
            if (flags[v] != 0) locked.push_back(mesh.vertices[v]);
        const auto less = [](Vec3 a, Vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; };
        std::sort(locked.begin(), locked.end(), less);

        const auto solids = array<kerf_cut_solid>(*from, in->solids, in->solid_count);
        bool has_changed = false;
        for (const kerf_cut& cut : array<kerf_cut>(*from, in->cuts, in->cut_count)) {
            if (cut.solid >= solids.size())
                return refuse(KERF_REMESH_REFUSED, *out, "a cut has a tool that does not exist");
            const kerf_cut_solid& solid = solids[cut.solid];
            const auto profile = array<kerf_profile_point>(*from, solid.profile, solid.profile_count);
            for (const remeshing::Profile run : solid.kerf == 0.0 ? convex_runs(profile) : std::vector{profile}) {
                const auto burr = SweptBurr::make(run, solid.kerf, cut.from, cut.to, why);
                if (!burr) return refuse(KERF_REMESH_DECLINED, *out, why);
                std::vector<std::uint8_t> is_locked;
                for (const Vec3 v : mesh.vertices)
                    is_locked.push_back(std::binary_search(locked.begin(), locked.end(), v, less));
                Triangles next = mesh;
                const Outcome made = displace(next, is_locked, *burr, wall_share * in->tolerance, cancelled, why);
                if (made == Outcome::cut) {
                    mesh = std::move(next);
                    has_changed = true;
                }
                if (made == Outcome::cancelled) return KERF_REMESH_CANCELLED;
                if (made == Outcome::declined) return refuse(KERF_REMESH_DECLINED, *out, why);
                if (made == Outcome::refused) return refuse(KERF_REMESH_REFUSED, *out, why);
            }
        }
        if (!has_changed) return KERF_REMESH_UNCHANGED;
        return write(mesh, *to, out->result)
                   ? KERF_OK
                   : refuse(KERF_REMESH_REFUSED, *out, "the arena has no room for the result");
    } catch (const std::exception& e) {
        return refuse(KERF_REMESH_REFUSED, *out, e.what());
    }
}

/// The library, its version and the flags that results depend on.
constexpr auto kernel = [] {
    auto text = std::to_array("OpenMesh 0.0, no fused multiply-add");
    text[9] = static_cast<char>('0' + OM_GET_VER);
    text[11] = static_cast<char>('0' + OM_GET_MAJ);
    return text;
}();
static_assert(OM_GET_VER < 10 && OM_GET_MAJ < 10, "the version in `kernel` has one digit for each number");

constexpr kerf_remesher remeshers[] = {
    {sizeof(kerf_remesher), KERF_REMESH_PATCH, "displace",
     "Moves the surface onto the swept burr, and declines where a wall would be pierced.", &displace_all, nullptr,
     nullptr}};

}  // namespace
}  // namespace kerf::remesh_displace

extern "C" __attribute__((visibility("default"))) const kerf_remesh_module kerf_remesh_entry;
extern "C" const kerf_remesh_module kerf_remesh_entry = {
    KERF_MAGIC,
    KERF_REMESH_DRAFT,
    sizeof(kerf_remesh_module),
    sizeof kerf::remesh_displace::remeshers / sizeof kerf::remesh_displace::remeshers[0],
    KERF_REMESH_SIZES_INIT,
    "kerf.remesh_displace",
    "0.1.0",
    "Apache-2.0",
    kerf::remesh_displace::kernel.data(),
    kerf::remesh_displace::remeshers};
