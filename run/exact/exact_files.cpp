// SPDX-License-Identifier: Apache-2.0
#include "run/exact/exact_files.h"

#include <filesystem>
#include <system_error>

#include "bone/surface/write_stl.h"
#include "core/field/pieces/present_bone.h"
#include "text/quantity.h"
#include "text/write_file.h"

namespace kerf::run {
namespace {

std::string file_of(std::size_t body) {
    return body == 0 ? "bone-exact.stl" : "bone-exact-" + std::to_string(body) + ".stl";
}

Mesh shown(const bone::TaggedMesh& exact) {
    Mesh mesh;
    mesh.vertices = exact.mesh.vertices;
    mesh.triangles.assign(exact.mesh.triangles.begin(), exact.mesh.triangles.end());
    return mesh;
}

}  // namespace

session::ExactRow exact_row(const bone::ExactSurface& made, const ExactStrategies& strategies) {
    session::ExactRow row;
    for (const ExactStrategies::Running& one : strategies.running()) {
        row.strategies.push_back({one.id, one.child->plugin(), one.child->kernel(), one.module_hash, {}});
        for (std::size_t p = 0; p < one.parameters.size(); ++p)
            row.strategies.back().parameters.emplace_back(
                one.parameters[p].id,
                text::quantity_text(one.child->program().parameters[p], one.parameters[p].display_unit));
    }
    row.why_not = made.error;
    if (made.error.empty())
        for (const bone::ExactPiece& piece : made.pieces)
            row.pieces.push_back({piece.body, file_of(piece.body), piece.mesh.mesh.triangles.size(), piece.volume,
                                  piece.field_volume, piece.wall_areas});
    row.digest = made.digest;
    row.records = made.records;
    row.stretches = made.stretches;
    row.removed = made.removed;
    row.field_removed = made.field_removed;
    row.allowed = made.allowed;
    row.crumbs = made.crumbs;
    row.crumb_volume = made.crumb_volume;
    row.refusals = made.refusals;
    row.handed_over = made.handed_over;
    row.notes = made.notes;
    return row;
}

std::string write_exact_surfaces(const std::string& folder, const bone::ExactSurface& made) {
    std::string error;
    std::error_code none;
    // Removes surfaces of an earlier result, which may have had more.
    for (std::size_t body = 0; body < max_bodies; ++body)
        std::filesystem::remove(std::filesystem::path(folder) / file_of(body), none);
    for (const bone::ExactPiece& piece : made.pieces)
        if (error.empty())
            error = text::write_file(folder + "/" + file_of(piece.body), bone::stl_bytes(shown(piece.mesh)));
    return error;
}

}  // namespace kerf::run
