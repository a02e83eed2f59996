// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bone/remesh/tagged_mesh.h"
#include "core/field/cut/cut_field.h"

/// Parts of an exact surface, and the bone of the field that they lie on.
namespace kerf {

/// A part of a mesh that hangs together.
struct MeshPart {
    TaggedMesh mesh;
    double volume = 0.0;  ///< [m³] negative: a cavity
};

/// Returns the parts of an accepted mesh.   [any] pure.
[[nodiscard]] std::vector<MeshPart> parts_of(const TaggedMesh& whole);

/// Adds the faces of one mesh to another.   [any]
void append(const TaggedMesh& more, TaggedMesh& mesh);

/// Returns the fraction of a part's vertices, as far as the field reaches, that have bone of any of some bodies within
/// a voxel; nothing where the field reaches none.   [any] pure.
[[nodiscard]] std::optional<double> fraction_on(const MeshPart& part, const Body& bone,
                                                const std::vector<const CutField*>& bodies);

/// Returns the area of the faces that tools left [m²], for each material of the bone.   [any] pure.
[[nodiscard]] std::vector<double> wall_areas_of(const TaggedMesh& mesh, const Body& bone);

}  // namespace kerf
