// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <cstring>
#include <span>

#include "booleans.h"

namespace kerf::remesh_cgal {
namespace {

template <class T>
std::span<const T> array(const kerf_arena& arena, kerf_offset at, std::size_t count) {
    return {reinterpret_cast<const T*>(arena.base + at), count};
}

/// Copies values behind what is in the arena. Returns their offset; 0 where there is no room.
template <class T>
kerf_offset append(kerf_arena& arena, const std::vector<T>& values) {
    const kerf_offset at = (arena.used + 7) / 8 * 8;
    const std::size_t size = values.size() * sizeof(T);
    if (at > arena.capacity || size > arena.capacity - at) return 0;
    std::memcpy(arena.base + at, values.data(), size);
    arena.used = at + size;
    return at;
}

Triangles read(const kerf_patch& patch, const kerf_arena& arena) {
    const auto copied = [](const auto& values, auto& to) { to.assign(values.begin(), values.end()); };
    Triangles mesh;
    copied(array<Vec3>(arena, patch.vertices, patch.vertex_count), mesh.vertices);
    copied(array<std::uint32_t>(arena, patch.triangles, 3 * std::size_t{patch.triangle_count}), mesh.triangles);
    copied(array<std::uint8_t>(arena, patch.tags, patch.triangle_count), mesh.tags);
    return mesh;
}

bool write(const Triangles& mesh, kerf_arena& arena, kerf_patch& patch) {
    patch.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
    patch.triangle_count = static_cast<std::uint32_t>(mesh.tags.size());
    patch.vertices = append(arena, mesh.vertices);
    patch.triangles = append(arena, mesh.triangles);
    patch.tags = append(arena, mesh.tags);
    patch.locked = 0;
    return mesh.tags.empty() || (patch.vertices != 0 && patch.triangles != 0 && patch.tags != 0);
}

kerf_status refuse(kerf_remesh_out& out, const std::string& why) {
    std::snprintf(out.message, sizeof out.message, "%s", why.c_str());
    return KERF_REMESH_REFUSED;
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
