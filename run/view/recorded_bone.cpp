// SPDX-License-Identifier: Apache-2.0
#include "run/view/recorded_bone.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "bone/surface/read_surface.h"
#include "bone/surface/repair.h"
#include "run/view/mesh_surface.h"
#include "session/drawn_surface.h"

namespace kerf::run {

namespace {

constexpr const char* stl_name = "bone.stl";

/// Returns the surface of a mesh; null if it has none, or is not within 100 m of the origin.
std::shared_ptr<const ViewedSurface> surface_of(const Mesh& mesh) {
    constexpr double farthest = 100.0;  // [m]
    if (std::ranges::any_of(mesh.vertices, [](Vec3 v) { return !(length(v) < farthest); })) return nullptr;
    auto body = viewed_surface(thinned(mesh, max_mesh_triangles));
    if (!body) return nullptr;
    auto surface = std::make_shared<ViewedSurface>();
    surface->version = 1;
    surface->bodies.push_back(std::move(*body));
    return surface;
}

/// Returns why the file of the bone cannot be used, for people; empty if it can.
std::string read_stl_file(const std::string& file, Mesh& mesh) {
    constexpr std::uintmax_t max_bytes = 200'000'000;
    constexpr double millimetre = 1e-3;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) return "is missing";
    if (size > max_bytes)
        return "has " + std::to_string(size / 1'000'000) + " MB, expected at most " +
               std::to_string(max_bytes / 1'000'000) + " MB";
    text::Diagnostics found;
    auto read = bone::read_surface(file).take(found);
    if (!read) return "cannot be read (" + (found.empty() ? "" : found.front().code) + ")";
    bone::weld(read->mesh);
    Mesh plain;
    for (const Vec3 v : read->mesh.vertices) plain.vertices.push_back(millimetre * v);
    plain.triangles = std::move(read->mesh.triangles);
    mesh = session::unpacked(session::drawn_surface(plain));  // it computes the normals
    return {};
}

}  // namespace

RecordedBone recorded_bone(const session::RecordedRun& run, const std::string& folder) {
    if (!run.has_result) return {.words = "no bone is drawn, because the run was cut short"};
    if (run.is_bone_placed && !run.drawn.bone().is_empty()) {
        auto surface = surface_of(session::unpacked(run.drawn.bone()));
        if (surface == nullptr) return {.words = "no bone is drawn, because its surface cannot be drawn"};
        return {std::move(surface), "the bone is as at the end"};
    }
    const std::string file = (std::filesystem::path(folder) / stl_name).string();
    Mesh mesh;
    if (const std::string why_not = read_stl_file(file, mesh); !why_not.empty())
        return {.words = std::string("no bone is drawn, because `") + stl_name + "` " + why_not};
    auto surface = surface_of(mesh);
    if (surface == nullptr)
        return {.words = std::string("no bone is drawn, because `") + stl_name + "` has no surface near the tool"};
    return {std::move(surface), std::string("the bone is that of `") + stl_name + "`, as at the end"};
}

}  // namespace kerf::run
