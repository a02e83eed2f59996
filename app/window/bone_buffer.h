// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "app/window/coarse_block.h"
#include "app/window/gl_objects.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// The surface of one body in a vertex and an index buffer, drawn by one call. Each block of bricks has a slot with
/// room to grow. Blocks near the tool have all triangles, others fewer if the body has too many.
class BoneBuffer {
public:
    static constexpr std::size_t enough_triangles = 150'000;

    BoneBuffer();

    /// Uploads the blocks that differ from those of the last call.
    /// @param tip  of the tool, body frame [m]
    void show(const run::ViewedBodySurface& surface, Vec3 tip);
    /// Draws all blocks with the program in use.
    void draw() const;
    [[nodiscard]] std::size_t triangles() const noexcept { return triangles_; }

private:
    /// Where the vertices and indices of a block lie, in elements.
    struct Slot {
        std::size_t first_vertex = 0, vertex_room = 0, first_index = 0, index_room = 0;
        GLsizei index_count = 0;
        int lattice = 0;  ///< 0: nothing is shown
    };
    void begin(const run::ViewedBodySurface& surface);
    [[nodiscard]] std::size_t block_of(std::size_t brick) const;
    [[nodiscard]] Block block(std::size_t number) const;
    [[nodiscard]] int lattice_for(std::size_t block, Vec3 tip) const;
    void replace(std::size_t block, int lattice);
    void upload(const Slot& slot, const BlockMesh& mesh) const;
    void upload_all();
    void list_draws();

    GlVertexArray array_;
    GlBuffer vertices_, indices_;
    std::optional<run::ViewedBodySurface> shown_;
    std::array<int, 3> blocks_{};  ///< per axis
    std::vector<Slot> slots_;      ///< by block
    int far_lattice_ = 1;
    Vec3 tip_{1e3, 0, 0};  ///< for which the blocks near the tool were chosen
    std::size_t used_vertices_ = 0, vertex_capacity_ = 0, used_indices_ = 0, index_capacity_ = 0;
    std::size_t triangles_ = 0;
    std::vector<GLsizei> counts_;
    std::vector<const void*> offsets_;
    std::vector<GLint> bases_;
};

}  // namespace kerf::window
