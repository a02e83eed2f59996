// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/remesh/paged_vector.h"
#include "bone/remesh/tagged_mesh.h"
#include "core/field/grid/box.h"

namespace kerf::bone {

/// A patch of a surface: some of its faces as a separate mesh.
struct SurfacePatch {
    TaggedMesh mesh;
    std::vector<std::uint8_t> locked;     ///< #vertices, 1: on the border to the rest
    std::vector<std::uint32_t> faces;     ///< their numbers in the surface, ascending
    std::vector<std::uint32_t> vertices;  ///< #vertices, their numbers in the surface
};

/// A surface that is cut patch by patch. The cost of finding and replacing faces depends on their number, not on the
/// size of the surface. The same operations give the same numbers.   [worker]
class GrowingSurface {
public:
    /// Pre: closed.
    explicit GrowingSurface(const TaggedMesh& mesh);

    /// Returns all faces whose boxes meet a box, and the faces that make their mesh 2-manifold.
    [[nodiscard]] SurfacePatch patch_in(const Box& box) const;
    /// Returns the faces outside a patch that have a vertex on its border.
    [[nodiscard]] TaggedMesh ring_of(const SurfacePatch& patch) const;
    /// Replaces a patch by a mesh. Vertices at positions of the patch's vertices keep their numbers.
    /// Pre: the mesh has the patch's border.
    void replace(const SurfacePatch& patch, const TaggedMesh& mesh);

    [[nodiscard]] std::size_t face_count() const noexcept { return face_count_; }
    /// Returns the whole surface.
    [[nodiscard]] TaggedMesh mesh() const;

    struct Face {
        Triangle corners{};  ///< vertex numbers
        std::uint8_t tag = 0, is_there = 0;
    };
    /// A snapshot of the surface. It never changes, and has common pages with other snapshots. Other threads may read
    /// it.
    struct Moment {
        Pages<Vec3> vertices;
        Pages<Face> faces;  ///< existing faces
        std::size_t face_count = 0;
        std::vector<std::uint32_t> free_faces, free_vertices;
    };
    [[nodiscard]] Moment moment();
    /// Restores a snapshot; later operations then give the same numbers as they would have given at that time. The cost
    /// depends on the number of changed pages with 1024 faces each.
    void restore(const Moment& moment);

private:
    static constexpr std::uint32_t no_face = 0xffffffffu;

    void add_face(const Triangle& corners, std::uint8_t tag);
    void remove_face(std::uint32_t face);
    void enter(std::uint32_t face);  ///< adds to the indices
    void strike(std::uint32_t face);
    template <class Visit>
    void for_each_cell(const Box& box, const Visit& visit) const;
    [[nodiscard]] Box box_of(std::uint32_t face) const noexcept;

    PagedVector<Vec3> vertices_;
    PagedVector<Face> faces_;
    std::vector<std::vector<std::uint32_t>> faces_at_;  ///< faces at each vertex
    std::vector<std::uint32_t> free_faces_, free_vertices_;
    std::size_t face_count_ = 0;
    Box bounds_{};
    double cell_ = 1.0;  ///< [m]
    std::array<std::size_t, 3> cells_{};
    std::vector<std::vector<std::uint32_t>> in_cell_;
    mutable std::vector<std::uint32_t> seen_;  ///< for each face, the last search that found it
    mutable std::uint32_t search_ = 0;
};

}  // namespace kerf::bone
