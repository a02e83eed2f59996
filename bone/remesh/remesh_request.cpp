// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/remesh_request.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

#include "kerf/remesh_mesh.hpp"

namespace kerf::bone {
namespace {

using remeshing::append;

constexpr std::uint64_t alignment = 8;

/// Reads an array; nothing if it is not completely in the arena.
template <class T>
std::optional<std::vector<T>> array(const kerf_arena& arena, kerf_offset at, std::size_t count) {
    std::vector<T> values;
    if (count == 0) return values;
    if (at == 0 || at % alignment != 0 || at > arena.capacity || count > (arena.capacity - at) / sizeof(T)) return {};
    values.resize(count);
    std::memcpy(values.data(), arena.base + at, count * sizeof(T));
    return values;
}

RemeshResult failed(const char* why) {
    RemeshResult result;
    result.message = why;
    return result;
}

}  // namespace

std::uint64_t request_bytes(const RemeshRequest& request) {
    const SurfaceMesh& mesh = request.base.mesh;
    constexpr std::size_t max_parts = 1 + max_gaps;
    std::uint64_t bytes = 64 + mesh.vertices.size() * (sizeof(Vec3) + 1) +
                          mesh.triangles.size() * (sizeof(Triangle) + 1) +
                          max_parts * request.cuts.size() * sizeof(kerf_cut);
    for (const ToolSolid* solid : request.solids)
        bytes += max_parts * (sizeof(kerf_cut_solid) + alignment + 2 * sizeof(kerf_profile_point)) +
                 solid->outline().size() * sizeof(kerf_profile_point);
    constexpr std::uint64_t max_parameters = 256;
    return bytes + max_parameters * sizeof(double) + 16 * alignment;
}

std::uint64_t result_bytes(const RemeshRequest& request) {
    constexpr std::uint64_t wall_bytes = std::uint64_t{256} << 20;  // for walls, which the base does not bound
    return 4 * request_bytes(request) + wall_bytes;
}

bool pack(const RemeshRequest& request, const std::vector<double>& parameters, kerf_arena& arena, kerf_remesh_in& in) {
    const SurfaceMesh& mesh = request.base.mesh;
    static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::uint32_t));
    in = {};
    in.size = sizeof in;
    in.mode = request.mode;
    in.nudge_seed = request.nudge_seed;
    in.tolerance = request.tolerance;
    in.base.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
    in.base.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
    in.base.vertices = append(arena, mesh.vertices.data(), mesh.vertices.size());
    in.base.triangles = append(arena, mesh.triangles.data(), mesh.triangles.size());
    in.base.tags = append(arena, request.base.tags.data(), request.base.tags.size());
    in.base.locked = append(arena, request.locked.data(), request.locked.size());

    // A solid in several parts is passed as several solids, and each of its cuts as one cut for each part.
    std::vector<kerf_cut_solid> solids;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> parts_of;  // for each solid: first part, number of parts
    bool fits = true;
    for (const ToolSolid* solid : request.solids) {
        const std::vector<ToolSolid> parts = solid->outline().empty() ? std::vector{*solid} : solid->each_part();
        parts_of.emplace_back(static_cast<std::uint32_t>(solids.size()), static_cast<std::uint32_t>(parts.size()));
        for (const ToolSolid& part : parts) {
            const auto& profile = part.outline();
            const kerf_offset at = append(arena, profile.data(), profile.size());
            fits = fits && (at != 0 || profile.empty());
            solids.push_back({part.is_prism() ? KERF_SOLID_PRISM : KERF_SOLID_REVOLUTION,
                              static_cast<std::uint32_t>(profile.size()), at, part.thickness(), part.bore()});
        }
    }
    std::vector<kerf_cut> cuts;
    const std::pair<std::uint32_t, std::uint32_t> unknown{static_cast<std::uint32_t>(solids.size()), 1};
    for (const CutStretch& cut : request.cuts) {
        const auto& [first, parts] = cut.solid < parts_of.size() ? parts_of[cut.solid] : unknown;
        for (std::uint32_t part = 0; part < parts; ++part) cuts.push_back({cut.from, cut.to, first + part, 0});
    }
    in.solids = append(arena, solids.data(), solids.size());
    in.cuts = append(arena, cuts.data(), cuts.size());
    in.solid_count = static_cast<std::uint32_t>(solids.size());
    in.cut_count = static_cast<std::uint32_t>(cuts.size());
    in.params = append(arena, parameters.data(), parameters.size());
    in.param_count = static_cast<std::uint32_t>(parameters.size());
    const std::uint32_t not_cancelled = 0;
    in.cancel = append(arena, &not_cancelled, 1);
    const auto is_there = [](kerf_offset at, std::size_t count) { return at != 0 || count == 0; };
    return fits && is_there(in.base.vertices, mesh.vertices.size()) &&
           is_there(in.base.triangles, mesh.triangles.size()) && is_there(in.base.tags, request.base.tags.size()) &&
           is_there(in.base.locked, request.locked.size()) && is_there(in.solids, solids.size()) &&
           is_there(in.cuts, cuts.size()) && is_there(in.params, parameters.size()) && in.cancel != 0;
}

RemeshResult unpack(kerf_status status, const kerf_remesh_out& out, const kerf_arena& arena) {
    RemeshResult result;
    result.status = status;
    const auto* end = static_cast<const char*>(std::memchr(out.message, 0, sizeof out.message));
    result.message.assign(out.message,
                          end == nullptr ? sizeof out.message : static_cast<std::size_t>(end - out.message));
    for (char& c : result.message)
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    result.want_low = {out.want_low[0], out.want_low[1], out.want_low[2]};
    result.want_high = {out.want_high[0], out.want_high[1], out.want_high[2]};
    if (status == KERF_REMESH_UNCHANGED || status == KERF_REMESH_CANCELLED || status == KERF_REMESH_REFUSED ||
        status == KERF_REMESH_DECLINED || status == KERF_FAILED)
        return result;
    if (status == KERF_REMESH_NEED_REGION)
        return is_finite(result.want_low) && is_finite(result.want_high) ? result
                                                                         : failed("it wants a region without bounds");
    if (status != KERF_OK) return failed("it returned an unknown status");

    const kerf_patch& patch = out.result;
    auto vertices = array<Vec3>(arena, patch.vertices, patch.vertex_count);
    auto triangles = array<Triangle>(arena, patch.triangles, patch.triangle_count);
    auto tags = array<std::uint8_t>(arena, patch.tags, patch.triangle_count);
    if (!vertices || !triangles || !tags) return failed("its mesh does not lie in the arena");
    if (!std::all_of(vertices->begin(), vertices->end(), [](Vec3 v) { return is_finite(v); }))
        return failed("a vertex of its mesh is no number");
    for (const Triangle& t : *triangles)
        for (const std::uint32_t corner : t)
            if (corner >= patch.vertex_count) return failed("a face of its mesh has a vertex that does not exist");
    for (const std::uint8_t tag : *tags)
        if (tag > KERF_FACE_WALL) return failed("a face of its mesh has an unknown tag");
    result.mesh = {{std::move(*vertices), std::move(*triangles)}, std::move(*tags)};
    return result;
}

}  // namespace kerf::bone
