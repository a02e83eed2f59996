// SPDX-License-Identifier: Apache-2.0
#include "core/import/break_bone.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/field/removed_volume.h"
#include "core/procedure/fracture.h"
#include "core/procedure/quantity.h"
#include "core/procedure/read_anatomy.h"

namespace kerf {

namespace {

constexpr double least_part = 1e-6;  // [m³] of bone on each side of a fracture [judgement]

/// What of a bone is farther than half the gap in front of the fracture (`side` 1), or behind it (−1).
Body part_of(const Body& bone, const Fracture& fracture, double side) {
    Body part = bone;
    part.surface = LevelSet::build(bone.grid(), [&](Vec3 p) {
        return std::max(bone.surface.at(locate(bone, p)), 0.5 * fracture.gap - side * in_front_of(fracture, p));
    });
    return part;
}

std::string in_cm3(double volume) { return quantity_text(std::round(volume * 1e8) * 1e-2, "") + " cm3"; }

}  // namespace

std::optional<Body> break_bone(Body& bone, const Anatomy& anatomy, Diagnostics& diagnostics) {
    const Fracture& fracture = *anatomy.fracture;
    Body fragment = part_of(bone, fracture, 1.0), rest = part_of(bone, fracture, -1.0);
    fragment.id = "fragment";
    const double in_front = bone_volume(fragment, CutField(fragment, 0)), behind = bone_volume(rest, CutField(rest, 0));
    if (std::min(in_front, behind) < least_part) {
        diagnostics.push_back(error_at(in_anatomy(anatomy, {"fracture"}), "E0605",
                                       "the fracture does not part the bone: " + in_cm3(in_front) +
                                           " of it are in front of the plane, " + in_cm3(behind) +
                                           " behind. Each side needs 1 cm3. Move `at` into the bone (LPS, "
                                           "millimetres), or turn `normal`."));
        return std::nullopt;
    }
    bone = std::move(rest);
    return fragment;
}

}  // namespace kerf
