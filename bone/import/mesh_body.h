// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "bone/report/import_report.h"
#include "bone/surface/read_surface.h"
#include "bone/surface/surface_mesh.h"
#include "bone/surface/thickness.h"
#include "core/field/grid/box.h"
#include "documents/anatomy.h"
#include "text/result.h"

/// Makes bone from a surface: reads, diagnoses and repairs it, and measures its walls.
///
///     W0648  the size fits no bone, but would in another unit
///     E0652  the axes lie outside the surface
///     E0655, W0658  walls that are too thin for the spacing (bone/import/make_body.h)
///     W0656  faces near the axes intersect
///     E0659  two solids cross or touch near the axes
///     W0657  so far from the origin that the file's numbers are coarse
///     W0686  so far from the origin that the numbers of written STL files are coarse
namespace kerf::bone {

/// Closed surfaces, oriented outwards. Metres, LPS.
struct MeshBone {
    SurfaceMesh surface;                      ///< outer surface only
    std::vector<SurfaceMesh> inner_surfaces;  ///< cavities and canal; closed, oriented out of the cavity
    Box region{};                             ///< around the axes; without axes, around the surface
    bool is_part = false;                     ///< data outside the region are not used
    std::vector<WallSample> walls;            ///< of the outside, from face to face, in the region
    ImportReport report;
};

/// Returns the whole boundary of the bone: the outer surface, and the cavities with faces oriented out of the bone.
[[nodiscard]] SurfaceMesh whole_surface_of(const MeshBone& bone);

/// Reads the files of `anatomy.mesh` and makes the bone.
/// Error: E064x … E065x. Pre: `anatomy.mesh`.   [main]
[[nodiscard]] text::Result<MeshBone> make_mesh_bone(const documents::Anatomy& anatomy);

/// Makes the bone from surfaces in memory, as their files contain them. `canal` may be null.   [main]
[[nodiscard]] text::Result<MeshBone> make_mesh_bone(const documents::Anatomy& anatomy, SurfaceFile surface,
                                                    const SurfaceFile* canal);

}  // namespace kerf::bone
