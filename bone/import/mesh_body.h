// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "bone/report/import_report.h"
#include "bone/surface/read_surface.h"
#include "bone/surface/surface_mesh.h"
#include "bone/surface/thickness.h"
#include "core/field/grid/box.h"
#include "documents/anatomy.h"

/// Bone out of a surface: read, looked at, mended where that is safe, and how thick its walls are.
///
///     W0648  the size is no bone's; it would be in another unit
///     E0652  the axes lie outside the surface
///     E0655, W0658  walls that are too thin for the spacing (bone/import/make_body.h)
///     W0656  faces near the axes cut through one another
///     W0657  so far from the origin that the file's numbers are coarse
namespace kerf {

/// Closed surfaces, their faces looking outwards. Metres, LPS.
struct MeshBone {
    SurfaceMesh surface;             ///< the outside alone
    std::vector<SurfaceMesh> rooms;  ///< in it without bone: cavities, canal; closed, facing out of the room
    Box region{};                    ///< around the axes; without axes around the surface
    bool is_part = false;            ///< what lies outside the region was not looked at
    std::vector<WallSample> walls;   ///< of the outside, from face to face, in the region
    ImportReport report;
};

/// All that bounds the bone in one: the outside, and its rooms with their faces looking into them, out of the bone.
[[nodiscard]] SurfaceMesh whole_surface_of(const MeshBone& bone);

/// Reads the files that `anatomy.mesh` names and makes the bone.
/// Error: E064x … E065x.   Pre: `anatomy.mesh`.   [main]
[[nodiscard]] std::optional<MeshBone> make_mesh_bone(const Anatomy& anatomy, Diagnostics& diagnostics);

/// The same for surfaces that are in memory, as their files hold them. `canal` may be null.   [main]
[[nodiscard]] std::optional<MeshBone> make_mesh_bone(const Anatomy& anatomy, SurfaceFile surface,
                                                     const SurfaceFile* canal, Diagnostics& diagnostics);

}  // namespace kerf
