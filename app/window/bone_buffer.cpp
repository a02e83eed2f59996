// SPDX-License-Identifier: Apache-2.0
#include "app/window/bone_buffer.h"

#include <array>
#include <utility>

namespace kerf::window {

namespace {

using Vertex = run::ViewedVertex;
using Triangle = std::array<std::uint16_t, 3>;

std::size_t with_room(std::size_t count) { return count + count / 4 + 8; }

const void* offset_of(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

BoneBuffer::BoneBuffer() : array_(make_vertex_array()), vertices_(make_buffer()), indices_(make_buffer()) {
    glBindVertexArray(array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    for (GLuint i = 0; i < 4; ++i) glEnableVertexAttribArray(i);
    constexpr GLsizei stride = sizeof(Vertex);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, offset_of(offsetof(Vertex, position)));
    glVertexAttribPointer(1, 3, GL_BYTE, GL_TRUE, stride, offset_of(offsetof(Vertex, normal)));
    glVertexAttribIPointer(2, 1, GL_UNSIGNED_BYTE, stride, offset_of(offsetof(Vertex, tissue)));
    glVertexAttribPointer(3, 1, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset_of(offsetof(Vertex, light)));
    glBindVertexArray(0);
}

void BoneBuffer::show(const run::ViewedBodySurface& surface, Vec3 tip) {
    if (!shown_ || shown_->patches.capacity() != surface.patches.capacity()) begin(surface);
    std::vector<std::uint8_t> is_changed(slots_.size(), 0);
    bool is_any = false;
    surface.patches.for_each_change_since(shown_->patches, [&](std::size_t brick, const auto&) {
        is_changed[block_of(brick)] = 1;
        is_any = true;
    });
    constexpr double step = 1e-3;  // [m] of the tip, after which the blocks near it are chosen anew
    const bool has_moved = far_lattice_ > 1 && length(tip - tip_) > step;
    if (!is_any && !has_moved) return;
    if (has_moved) tip_ = tip;
    shown_ = surface;
    glBindVertexArray(array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
    for (std::size_t block = 0; block < slots_.size(); ++block) {
        const bool is_used = slots_[block].lattice > 0 || is_changed[block] != 0;
        if (!is_used) continue;
        const int lattice = lattice_for(block, tip_);
        if (is_changed[block] != 0 || slots_[block].lattice != lattice) replace(block, lattice);
    }
    if (used_vertices_ > vertex_capacity_ || used_indices_ > index_capacity_) upload_all();
    glBindVertexArray(0);
    list_draws();
}

/// Begins with another body: chooses how coarse blocks far from the tool are.
void BoneBuffer::begin(const run::ViewedBodySurface& surface) {
    std::size_t triangles = 0;
    for (std::size_t brick = 0; brick < surface.patches.capacity(); ++brick)
        if (const auto& patch = surface.patches[brick]; patch != nullptr) triangles += patch->triangles.size();
    // Measured fractions of triangles that are left at each lattice.
    constexpr std::array<std::pair<int, double>, 4> lattices{{{1, 1.0}, {2, 0.37}, {3, 0.26}, {4, 0.22}}};
    for (const auto& [lattice, fraction] : lattices) {
        far_lattice_ = lattice;
        if (fraction * static_cast<double>(triangles) <= static_cast<double>(enough_triangles)) break;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) blocks_[axis] = (surface.bricks[axis] + Block::edge - 1) / Block::edge;
    shown_ = surface;
    shown_->patches = PagedTable<run::ViewedPatch>(surface.patches.capacity());
    slots_.assign(static_cast<std::size_t>(blocks_[0] * blocks_[1] * blocks_[2]), Slot{});
    used_vertices_ = used_indices_ = vertex_capacity_ = index_capacity_ = 0;
}

std::size_t BoneBuffer::block_of(std::size_t brick) const {
    const auto& n = shown_->bricks;
    const int index = static_cast<int>(brick), i = index % n[0], j = index / n[0] % n[1], k = index / n[0] / n[1];
    return static_cast<std::size_t>(((k / Block::edge) * blocks_[1] + j / Block::edge) * blocks_[0] + i / Block::edge);
}

Block BoneBuffer::block(std::size_t number) const {
    const int index = static_cast<int>(number);
    return {{Block::edge * (index % blocks_[0]), Block::edge * (index / blocks_[0] % blocks_[1]),
             Block::edge * (index / blocks_[0] / blocks_[1])}};
}

/// Returns how coarse a block is drawn: not at all near the tip.
int BoneBuffer::lattice_for(std::size_t number, Vec3 tip) const {
    constexpr double near = 10e-3;  // [m]
    const std::array<int, 3> first = block(number).first_brick;
    const double size = 8.0 * shown_->spacing, half = 0.5 * Block::edge * size;
    const Vec3 middle = shown_->origin + Vec3{size * first[0] + half, size * first[1] + half, size * first[2] + half};
    return length(middle - tip) < near + 1.7 * half ? 1 : far_lattice_;
}

/// Puts a block into its slot, or a new slot at the end. Slots beyond the buffers are uploaded with all others.
void BoneBuffer::replace(std::size_t number, int lattice) {
    const BlockMesh mesh = block_mesh(*shown_, block(number), lattice);
    Slot& slot = slots_[number];
    const std::size_t indices = 3 * mesh.triangles.size();
    slot.index_count = static_cast<GLsizei>(indices);
    slot.lattice = lattice;
    if (indices == 0) return;
    if (mesh.vertices.size() > slot.vertex_room || indices > slot.index_room) {
        slot.first_vertex = used_vertices_;
        slot.vertex_room = with_room(mesh.vertices.size());
        slot.first_index = used_indices_;
        slot.index_room = with_room(indices);
        used_vertices_ += slot.vertex_room;
        used_indices_ += slot.index_room;
    }
    if (used_vertices_ <= vertex_capacity_ && used_indices_ <= index_capacity_) upload(slot, mesh);
}

void BoneBuffer::upload(const Slot& slot, const BlockMesh& mesh) const {
    glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(sizeof(Vertex) * slot.first_vertex),
                    static_cast<GLsizeiptr>(sizeof(Vertex) * mesh.vertices.size()), mesh.vertices.data());
    glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLintptr>(sizeof(std::uint16_t) * slot.first_index),
                    static_cast<GLsizeiptr>(sizeof(Triangle) * mesh.triangles.size()), mesh.triangles.data());
}

/// Packs all slots anew into larger buffers.
void BoneBuffer::upload_all() {
    std::vector<std::pair<std::size_t, BlockMesh>> meshes;
    used_vertices_ = used_indices_ = 0;
    for (std::size_t number = 0; number < slots_.size(); ++number) {
        Slot& slot = slots_[number];
        if (slot.lattice == 0) continue;
        const BlockMesh& mesh = meshes.emplace_back(number, block_mesh(*shown_, block(number), slot.lattice)).second;
        const std::size_t indices = 3 * mesh.triangles.size();
        slot = {used_vertices_,     with_room(mesh.vertices.size()), used_indices_,
                with_room(indices), static_cast<GLsizei>(indices),   slot.lattice};
        used_vertices_ += slot.vertex_room;
        used_indices_ += slot.index_room;
    }
    vertex_capacity_ = used_vertices_ + used_vertices_ / 2;
    index_capacity_ = used_indices_ + used_indices_ / 2;
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(sizeof(Vertex) * vertex_capacity_), nullptr, GL_DYNAMIC_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(sizeof(std::uint16_t) * index_capacity_), nullptr,
                 GL_DYNAMIC_DRAW);
    for (const auto& [number, mesh] : meshes) upload(slots_[number], mesh);
}

void BoneBuffer::list_draws() {
    counts_.clear();
    offsets_.clear();
    bases_.clear();
    triangles_ = 0;
    for (const Slot& slot : slots_) {
        if (slot.index_count == 0) continue;
        counts_.push_back(slot.index_count);
        offsets_.push_back(offset_of(sizeof(std::uint16_t) * slot.first_index));
        bases_.push_back(static_cast<GLint>(slot.first_vertex));
        triangles_ += static_cast<std::size_t>(slot.index_count) / 3;
    }
}

void BoneBuffer::draw() const {
    if (counts_.empty()) return;
    glBindVertexArray(array_.get());
    glMultiDrawElementsBaseVertex(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_SHORT,
                                  const_cast<const void* const*>(offsets_.data()), static_cast<GLsizei>(counts_.size()),
                                  const_cast<GLint*>(bases_.data()));
}

}  // namespace kerf::window
