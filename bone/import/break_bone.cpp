// SPDX-License-Identifier: Apache-2.0
#include "bone/import/break_bone.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/field/cut/removed_volume.h"
#include "documents/fracture.h"
#include "documents/read_anatomy.h"
#include "text/quantity.h"

namespace kerf::bone {

namespace {

constexpr double min_part = 1e-6;  // [m³] of bone on each side of a fracture [judgement]

/// Returns the part of a bone more than half the gap in front of the fracture (`side` 1) or behind it (−1).
Body part_of(const Body& bone, const documents::Fracture& fracture, double side) {
    Body part = bone;
    part.surface = LevelSet::build(bone.grid(), [&](Vec3 p) {
        return std::max(bone.surface.at(locate(bone, p)),
                        0.5 * fracture.gap - side * documents::in_front_of(fracture, p));
    });
    return part;
}

/// Notes the position of the fragment, and warns if it overlaps the rest.
void note_fragment(const Body& fragment, const Body& rest, const documents::Anatomy& anatomy, ImportReport& report,
                   text::Diagnostics& diagnostics) {
    constexpr double apart = 1e-3, largest = 0.01;  // [m]; [–] of the fragment
    const documents::Fracture& fracture = *anatomy.fracture;
    const Pose world_from = documents::world_from_fragment(fracture);
    const Grid& grid = fragment.grid();
    const double brick = grid.spacing * brick_edge;
    const Vec3 size{brick * grid.bricks[0], brick * grid.bricks[1], brick * grid.bricks[2]};
    std::size_t all = 0, inside = 0;
    for (double x = 0.5 * apart; x < size.x; x += apart)
        for (double y = 0.5 * apart; y < size.y; y += apart)
            for (double z = 0.5 * apart; z < size.z; z += apart) {
                const Vec3 point = grid.origin + Vec3{x, y, z};
                if (uncut_distance(fragment, locate(fragment, point)) >= 0.0) continue;
                ++all;
                inside += uncut_distance(rest, locate(rest, world_from * point)) < 0.0;
            }
    const auto in_cm3 = [](std::size_t points) { return rounded(static_cast<double>(points) * 1e-3, 1) + " cm3"; };
    report.notes.push_back("Fracture: the fragment has " + in_cm3(all) + " and lies " +
                           rounded(1e3 * length(world_from * fracture.at - fracture.at), 1) +
                           " mm from its place, turned by " + rounded(std::abs(fracture.turn) * 180.0 / pi, 1) +
                           " deg.");
    if (static_cast<double>(inside) > largest * static_cast<double>(all))
        diagnostics.push_back(
            text::warning_at(documents::in_anatomy(anatomy, {"fracture"}), "W0606",
                             in_cm3(inside) + " of the fragment's " + in_cm3(all) +
                                 " lie in the rest of the bone. Move it along `normal`, or turn it less."));
}

std::string in_cm3(double volume) { return text::quantity_text(std::round(volume * 1e8) * 1e-2, "") + " cm3"; }

}  // namespace

text::Result<Body> break_bone(Body& bone, const documents::Anatomy& anatomy, ImportReport& report) {
    text::Diagnostics diagnostics;
    const documents::Fracture& fracture = *anatomy.fracture;
    Body fragment = part_of(bone, fracture, 1.0), rest = part_of(bone, fracture, -1.0);
    fragment.id = "fragment";
    const double in_front = bone_volume(fragment, CutField(fragment, 0)), behind = bone_volume(rest, CutField(rest, 0));
    if (std::min(in_front, behind) < min_part) {
        diagnostics.push_back(text::error_at(documents::in_anatomy(anatomy, {"fracture"}), "E0605",
                                             "the fracture does not part the bone: " + in_cm3(in_front) +
                                                 " of it are in front of the plane, " + in_cm3(behind) +
                                                 " behind. Each side needs 1 cm3. Move `at` into the bone (LPS, "
                                                 "millimetres), or turn `normal`."));
        return diagnostics;
    }
    bone = std::move(rest);
    note_fragment(fragment, bone, anatomy, report, diagnostics);
    return {std::move(fragment), std::move(diagnostics)};
}

}  // namespace kerf::bone
