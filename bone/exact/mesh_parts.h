// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bone/remesh/tagged_mesh.h"
#include "core/field/cut/cut_field.h"

/// Parts of an exact surface, and the bodies of the field on which they lie.
namespace kerf::bone {

/// A connected part of a mesh.
struct MeshPart {
    TaggedMesh mesh;
    double volume = 0.0;  ///< [m³] negative: a cavity
};

/// Returns the parts of an accepted mesh.   [any] pure.
[[nodiscard]] std::vector<MeshPart> parts_of(const TaggedMesh& whole);

/// Appends the faces of one mesh to another.   [any]
void append(const TaggedMesh& more, TaggedMesh& mesh);

/// Returns the fraction of a part's area whose vertices have bone of any of the bodies within a voxel. Vertices beyond
/// the field do not count; nothing if all are beyond it.   [any] pure.
[[nodiscard]] std::optional<double> fraction_on(const MeshPart& part, const Body& bone,
                                                const std::vector<const CutField*>& bodies);

/// Returns the area of the walls cut by tools [m²], for each material of the bone.   [any] pure.
[[nodiscard]] std::vector<double> wall_areas_of(const TaggedMesh& mesh, const Body& bone);

}  // namespace kerf::bone
