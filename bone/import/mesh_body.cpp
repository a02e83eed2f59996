// SPDX-License-Identifier: Apache-2.0
#include "bone/import/mesh_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "bone/import/data_file.h"
#include "bone/import/fit_landmarks.h"
#include "bone/import/planned_region.h"
#include "bone/surface/diagnose.h"
#include "bone/surface/repair.h"
#include "bone/surface/signed_distance.h"
#include "documents/read_anatomy.h"

namespace kerf::bone {
namespace {

constexpr double coarse = 20e-6;     // [m] resolution of the file's numbers that is worth a warning
constexpr double fineness = 0.5e-3;  // [m] between points where walls are measured

/// Converts a mesh to metres and LPS.
void place(SurfaceMesh& mesh, double unit, bool is_ras) {
    const double across = is_ras ? -unit : unit;
    for (Vec3& v : mesh.vertices) v = {across * v.x, across * v.y, unit * v.z};
}

/// Checks frame and unit in the file's header against the document.
std::optional<SurfaceError> contradiction(const SurfaceFile& file, const documents::MeshSource& source) {
    const auto frame = [](bool is_ras) { return std::string(is_ras ? "RAS" : "LPS"); };
    const auto unit = [](double metres) {
        return std::string(metres == 1e-2 ? "cm" : metres == 1.0 ? "m" : metres == 1e-6 ? "um" : "mm");
    };
    if (source.names_frame && file.is_ras && *file.is_ras != source.is_ras)
        return SurfaceError{"E0654",
                            "the file's header says SPACE=" + frame(*file.is_ras) + ", `frame` says " +
                                frame(source.is_ras) + "; the two must agree.",
                            "Remove `mesh.frame` or `--frame` if the header is right; otherwise correct the header."};
    if (file.unit && *file.unit != source.unit)
        return SurfaceError{"E0654",
                            "the file's header says UNITS=" + unit(*file.unit) + ", `unit` is " + unit(source.unit) +
                                "; the two must agree.",
                            "Write `unit: " + unit(*file.unit) + "` or `--unit " + unit(*file.unit) +
                                "` if the header is right; otherwise correct the header."};
    return std::nullopt;
}

/// Returns whether a file is in RAS, by the document, its own header, or the other file of the same bone; otherwise
/// LPS.
bool is_in_ras(const SurfaceFile& file, const SurfaceFile* other, const documents::MeshSource& source) {
    if (source.names_frame) return source.is_ras;
    return file.is_ras.value_or(other != nullptr && other->is_ras.value_or(false));
}

std::string frame_note(const SurfaceFile& file, const SurfaceFile* other, const documents::MeshSource& source) {
    const std::string frame = is_in_ras(file, other, source) ? "RAS, turned to LPS" : "LPS";
    if (file.is_ras) return "Frame: " + frame + ", as the file's header says.";
    if (source.names_frame) return "Frame: " + frame + ", as `mesh.frame` says.";
    if (other != nullptr && other->is_ras) return "Frame: " + frame + ", as the header of the other file says.";
    return "Frame: " + frame + ", supposed: the file does not say, nor does `mesh.frame`.";
}

bool is_within(const Box& box, Vec3 p) noexcept {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x && p.y <= box.high.y &&
           p.z <= box.high.z;
}

std::string millimetres(double metres, int digits = 1) { return rounded(metres * 1e3, digits) + " mm"; }

/// Whether two pieces bound bone, and not bone and a cavity in it. Pieces that the repair leaves out are ignored.
bool are_two_solids(const SurfacePiece& one, const SurfacePiece& other, const documents::MeshSource& source) {
    return one.volume * other.volume > 0.0 &&
           std::min(std::abs(one.volume), std::abs(other.volume)) >= source.pieces_under;
}

/// Diagnoses and repairs the surface, with notes and warnings. Returns false, with an error, if it cannot be repaired.
bool make_sound(SurfaceFile& file, const SurfaceFile* other, const documents::Anatomy& anatomy, const std::string& name,
                std::vector<std::string>& notes, text::Diagnostics& diagnostics) {
    const documents::MeshSource& source = *anatomy.mesh;
    const auto warn = [&](const char* code, const std::string& message, const std::string& advice) {
        diagnostics.push_back(text::warning_about(name, code, message + " " + advice));
    };
    if (const auto error = contradiction(file, source)) {
        diagnostics.push_back(text::error_about(name, error->code, error->message + " " + error->advice));
        return false;
    }
    place(file.mesh, source.unit, is_in_ras(file, other, source));
    if (!file.has_topology) weld(file.mesh);  // STL repeats every vertex in each of its faces
    const SurfaceDiagnosis found = diagnose(file.mesh, source.unit);
    for (std::string& note : to_notes(found)) notes.push_back(std::move(note));

    if (!found.likely_unit.empty()) {
        const Vec3 extent = found.bounds.high - found.bounds.low;
        warn("W0648",
             "the surface is " + millimetres(std::max({extent.x, extent.y, extent.z}), 3) + " long, which no bone is.",
             "If its numbers are in another unit, write `unit: " + found.likely_unit + "`.");
    }
    if (file.has_floats && found.float_step > coarse)
        warn("W0657",
             "the surface lies so far from the origin that its file's numbers are steps of " +
                 millimetres(found.float_step, 2) + "; bone needs 0.02 mm.",
             "Move it to the origin where it was made, and export it again.");
    else if (found.float_step > coarse)
        warn("W0686",
             "the surface lies so far from the origin that the STL files of a run have steps of " +
                 millimetres(found.float_step, 2) + "; bone needs 0.02 mm.",
             "Move it to the origin where it was made, and export it again.");
    const Box region = planned_region(anatomy.axes, found.bounds);
    const auto is_near = [&](const FaceCrossing& one) { return anatomy.axes.empty() || is_within(region, one.at); };
    const auto crosses_solids = [&](const FaceCrossing& one) {
        return is_near(one) && are_two_solids(found.pieces[one.pieces[0]], found.pieces[one.pieces[1]], source) &&
               one.pieces[0] != one.pieces[1];
    };
    const auto cross = std::find_if(found.crossing.begin(), found.crossing.end(), crosses_solids);
    const auto touch = std::find_if(found.touching.begin(), found.touching.end(), is_near);
    if (cross != found.crossing.end() || touch != found.touching.end()) {
        const FaceCrossing& one = cross != found.crossing.end() ? *cross : *touch;
        const auto volume = [&](std::size_t piece) {
            return rounded(std::abs(found.pieces[piece].volume) * 1e6, 2) + " cm3";
        };
        diagnostics.push_back(text::error_about(
            name, "E0659",
            "two parts of the surface" +
                (one.pieces[0] == one.pieces[1]
                     ? std::string()
                     : ", of " + volume(one.pieces[0]) + " and " + volume(one.pieces[1]) + ",") +
                (cross != found.crossing.end() ? " cross" : " touch") + " near " + position_text(one.at) +
                ". Join them into one surface in the program that made them, by a boolean union."));
        return false;
    }
    const auto near = std::count_if(found.crossing.begin(), found.crossing.end(), is_near);
    if (near > 0)
        warn("W0656",
             std::to_string(near) + (near == 1 ? " pair" : " pairs") +
                 " of faces near the axes cut through one another, the first at " + position_text(found.crossings.at) +
                 "; bone may feel thin where they do.",
             "Join the parts of the surface into one in the program that made it.");

    const RepairRules rules{source.holes_up_to, source.pieces_under, source.inner};
    if (const auto error = repair(file.mesh, rules, notes)) {
        diagnostics.push_back(text::error_about(name, error->code, error->message + " " + error->advice));
        return false;
    }
    return true;
}

/// Returns a closed tube with flat ends. Its polygon has the area of the tube's circle.
SurfaceMesh mesh_of(const documents::TubeSolid& tube) {
    constexpr std::uint32_t sides = 64;
    const Vec3 along = normalized(tube.to - tube.from);
    const Vec3 other = std::abs(along.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 right = normalized(cross(other, along)), up = cross(along, right);
    const double turn = 2.0 * 3.14159265358979323846 / sides;
    const double radius = tube.radius * std::sqrt(turn / std::sin(turn));
    SurfaceMesh mesh;
    mesh.vertices = {tube.from, tube.to};
    for (std::uint32_t i = 0; i < sides; ++i) {
        const Vec3 out = radius * (std::cos(turn * i) * right + std::sin(turn * i) * up);
        mesh.vertices.push_back(tube.from + out);
        mesh.vertices.push_back(tube.to + out);
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = 2 + 2 * i, b = a + 1, c = 2 + 2 * ((i + 1) % sides), d = c + 1;
        mesh.triangles.insert(mesh.triangles.end(), {Triangle{a, c, b}, {c, d, b}, {0, c, a}, {1, b, d}});
    }
    return mesh;
}

void note_walls(const MeshBone& bone, std::vector<std::string>& notes) {
    const auto smallest = thinnest(bone.walls);
    if (!smallest) return;
    notes.push_back("Walls from face to face, straight inwards: thinnest " + millimetres(smallest->thickness, 2) +
                    ", at " + position_text(smallest->at) + "; 1 % of the surface is under " +
                    millimetres(thickness_at(bone.walls, 0.01), 2) + ", half under " +
                    millimetres(thickness_at(bone.walls, 0.5), 2) + ".");
}

}  // namespace

SurfaceMesh whole_surface_of(const MeshBone& bone) {
    SurfaceMesh whole = bone.surface;
    for (const SurfaceMesh& cavity : bone.inner_surfaces) {
        const auto first = static_cast<std::uint32_t>(whole.vertices.size());
        whole.vertices.insert(whole.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
        for (const Triangle& t : cavity.triangles)
            whole.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
    }
    return whole;
}

text::Result<MeshBone> make_mesh_bone(const documents::Anatomy& planned, SurfaceFile surface,
                                      const SurfaceFile* canal) {
    text::Diagnostics diagnostics;
    documents::Anatomy anatomy = planned;
    const documents::MeshSource& source = *anatomy.mesh;
    MeshBone bone;
    std::vector<std::string>& notes = bone.report.notes;
    const std::optional<bool> frame_of_surface = surface.is_ras;
    notes.push_back(frame_note(surface, canal, source));
    const auto is_sound = [&](SurfaceFile& file, const SurfaceFile* other, const std::string& written,
                              const std::vector<std::string>& keys) {
        const std::size_t first = diagnostics.size();
        const std::string name =
            written.empty() ? anatomy.file : found_data_file(written, anatomy.file);  // without a path, the document
        const bool is_made = make_sound(file, other, anatomy, name, notes, diagnostics);
        if (diagnostics.size() > first)
            text::because_of(documents::in_anatomy(anatomy, keys, "the file is named here."), diagnostics, first);
        return is_made;
    };
    if (!is_sound(surface, canal, source.file, {"mesh", "file"})) return diagnostics;
    bone.surface = std::move(surface.mesh);
    if (SurfaceMesh cavities = taken_cavities(bone.surface); !cavities.triangles.empty())
        bone.inner_surfaces.push_back(std::move(cavities));
    const Box bounds = bone.region = bounds_of(bone.surface);
    if (canal) {
        notes.push_back("The canal, a surface of its own:");
        SurfaceFile cavity = *canal, outside;
        outside.is_ras = frame_of_surface;
        if (is_in_ras(cavity, &outside, source) != is_in_ras(outside, canal, source))
            notes.push_back(frame_note(cavity, &outside, source));
        if (!is_sound(cavity, &outside, source.canal_file, {"mesh", "canal", "file"})) return diagnostics;
        bone.inner_surfaces.push_back(std::move(cavity.mesh));
    } else if (source.canal) {
        notes.push_back("Canal: a tube of " + millimetres(2.0 * source.canal->radius) + " diameter, " +
                        millimetres(length(source.canal->to - source.canal->from)) + " long.");
        bone.inner_surfaces.push_back(mesh_of(*source.canal));
    }

    if (has_fits(anatomy)) {
        const TriangleTree tree(bone.surface);
        const BoneShape shape{SignedDistance(tree), grown(bounds, 1.0 /* beyond it is only air */)};
        if (!fit_landmarks(anatomy, shape, bone.report, diagnostics)) return diagnostics;
    }
    if (!anatomy.axes.empty()) {
        // A margin of air, so that a region around the whole bone ends outside it.
        bone.region = planned_region(anatomy.axes, grown(bounds, 1e-3));
        bone.is_part = true;
        if (is_empty(bone.region)) {
            text::Diagnostic apart = text::error_at(
                documents::in_anatomy(anatomy, {"landmarks", "axes"}), "E0652",
                "the landmarks' axes lie outside the surface, which goes from " + position_text(bounds.low) + " to " +
                    position_text(bounds.high) + ". Check that the axes are LPS, and `mesh.unit` and `mesh.frame`.");
            apart.reason = documents::in_anatomy(anatomy, {"mesh", "file"}, "the surface is named here.");
            diagnostics.push_back(std::move(apart));
            return diagnostics;
        }
        const Vec3 extent = bone.region.high - bone.region.low;
        notes.push_back("Of it " + rounded(extent.x * 1e3, 0) + " × " + rounded(extent.y * 1e3, 0) + " × " +
                        rounded(extent.z * 1e3, 0) +
                        " mm around the planned axes. Beyond, bone goes on and cannot be cut.");
    }
    bone.walls = measure_walls(bone.surface, TriangleTree(bone.surface), bone.region, fineness);
    note_walls(bone, notes);
    if (anatomy.tissues.size() == 1)
        notes.push_back("A surface shows no tissues, and none is given a thickness: all of the bone is " +
                        anatomy.tissues[0].id + ".");
    return {std::move(bone), std::move(diagnostics)};
}

text::Result<MeshBone> make_mesh_bone(const documents::Anatomy& anatomy) {
    text::Diagnostics diagnostics;
    ImportReport files;
    const auto read = [&](const std::string& written, const std::vector<std::string>& keys) {
        const std::string file = found_data_file(written, anatomy.file);
        const std::size_t first = diagnostics.size();
        std::optional<SurfaceFile> surface;
        if (is_data_file_inside(file, anatomy.file, diagnostics)) surface = read_surface(file).take(diagnostics);
        if (surface && !hash_of_file(file, files.file_hashes.emplace_back())) {
            diagnostics.push_back(
                text::error_about(file, "E0640", "the file could be read once, but not again. Try again."));
            surface.reset();
        }
        if (diagnostics.size() > first)
            text::because_of(documents::in_anatomy(anatomy, keys, "the file is named here."), diagnostics, first);
        return surface;
    };
    auto surface = read(anatomy.mesh->file, {"mesh", "file"});
    if (!surface) return diagnostics;
    std::optional<SurfaceFile> canal;
    if (!anatomy.mesh->canal_file.empty() && !(canal = read(anatomy.mesh->canal_file, {"mesh", "canal", "file"})))
        return diagnostics;
    auto bone = make_mesh_bone(anatomy, std::move(*surface), canal ? &*canal : nullptr).take(diagnostics);
    if (!bone) return diagnostics;
    bone->report.file_hashes = std::move(files.file_hashes);
    return {std::move(*bone), std::move(diagnostics)};
}

}  // namespace kerf::bone
