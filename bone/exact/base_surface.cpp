// SPDX-License-Identifier: Apache-2.0
#include "bone/exact/base_surface.h"

#include "bone/import/mesh_body.h"
#include "bone/remesh/base_mesh.h"

namespace kerf::bone {

std::optional<SurfaceMesh> base_surface(const documents::Anatomy* own, const Body& bone,
                                        std::vector<std::string>& notes, std::string& error) {
    std::string flaw;
    if (own != nullptr) {
        if (const auto read = make_mesh_bone(*own)) {  // the scene has reported its diagnostics
            SurfaceMesh surface = whole_surface_of(*read);
            remove_flat_faces(surface);
            flaw = flaw_of_base(surface);
            if (flaw.empty()) {
                notes.emplace_back("Base: the anatomy's own surface.");
                return surface;
            }
            notes.push_back("The anatomy's own surface cannot be cut exactly: " + flaw +
                            ". The surface of the field is used instead.");
        }
    }
    SurfaceMesh surface = field_surface(bone);
    flaw = flaw_of_base(surface);
    if (flaw.empty()) {
        notes.push_back("Base: the surface of the field of `" + bone.id + "`.");
        return surface;
    }
    error = "the surface of `" + bone.id + "` cannot be cut exactly: " + flaw + ".";
    return std::nullopt;
}

}  // namespace kerf::bone
