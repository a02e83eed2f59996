// SPDX-License-Identifier: Apache-2.0
#include "core/field/surface/patch_weld.h"

#include "core/field/grid/brick_memory.h"

namespace kerf {

namespace {

/// The faces of a brick on which a slot lies: bits 0 … 2 for the lower ones, 3 … 5 for the upper ones.
constexpr std::array<std::uint8_t, 10 * slot_layer> faces_of_slot = [] {
    std::array<std::uint8_t, 10 * slot_layer> faces{};
    for (std::size_t slot = 0; slot < faces.size(); ++slot)
        for (unsigned axis = 0; axis < 3; ++axis) {
            const std::size_t at = slot >> 4 * axis & 15;
            if (at == 1) faces[slot] = static_cast<std::uint8_t>(faces[slot] | 1U << axis);
            if (at == 9) faces[slot] = static_cast<std::uint8_t>(faces[slot] | 8U << axis);
        }
    return faces;
}();

constexpr std::uint32_t none = 0;

}  // namespace

PatchWeld::PatchWeld(const Grid& grid, std::size_t vertices, std::size_t triangles)
    : grid_(grid), first_shared_(grid.brick_count()) {
    const auto reserve = [](auto& list, std::size_t count) {
        list.reserve(count);
        prefer_huge_pages(list.data(), count * sizeof(*list.data()));
    };
    reserve(mesh_.vertices, vertices);
    reserve(mesh_.normals, vertices);
    reserve(mesh_.tissue, vertices);
    reserve(mesh_.triangles, triangles);
}

void PatchWeld::add(std::size_t brick, const PatchView& patch) {
    const Numbered numbered = number(brick, patch);
    append(patch, numbered.fresh);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first_shared_[brick][axis] = static_cast<std::uint32_t>(shared_.size());
        const std::uint32_t* begin = upper_[axis].data();
        shared_.insert(shared_.end(), begin, numbered.upper_end[axis]);
    }
    shared_.push_back(none);  // so that reading one past the end is valid
}

PatchWeld::Numbered PatchWeld::number(std::size_t brick, const PatchView& patch) {
    const std::size_t row = static_cast<std::size_t>(grid_.bricks[0]),
                      layer = row * static_cast<std::size_t>(grid_.bricks[1]);
    const std::array<bool, 3> has_lower{brick % row != 0, brick % layer >= row, brick >= layer};
    const std::array<std::size_t, 3> below{1, row, layer};

    // Vertices on a face to a lower neighbour already have mesh indices, listed in the same order as here.
    std::array<const std::uint32_t*, 3> known;
    unsigned lower_faces = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        known[axis] =
            has_lower[axis] && !shared_.empty() ? shared_.data() + first_shared_[brick - below[axis]][axis] : &none;
        lower_faces |= unsigned{has_lower[axis]} << axis;
    }

    // New vertices: first those on no face, then those on upper faces alone.
    const std::size_t count = patch.vertices.size();
    number_.resize(count);
    fresh_.resize(count + 1);
    on_face_.resize(count + 1);
    std::uint32_t fresh = 0, on_face = 0, *fresh_list = fresh_.data(), *face_list = on_face_.data(),
                  *numbers = number_.data();
    const std::uint16_t* edges = patch.edges.data();
    const auto faces_of = [&](std::size_t v) -> unsigned {
        return faces_of_slot[edges[v] & 0xfff] & ~(9U << (edges[v] >> 12)) & (lower_faces | 0x38);
    };
    for (std::uint32_t v = 0; v < count; ++v) {
        const bool is_inner = faces_of(v) == 0;
        fresh_list[fresh] = face_list[on_face] = v;
        fresh += is_inner;
        on_face += !is_inner;
    }
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (std::uint32_t n = 0; n < fresh; ++n) numbers[fresh_list[n]] = first + n;
    for (auto& upper : upper_) upper.resize(on_face + 1);
    std::array<std::uint32_t*, 3> upper{upper_[0].data(), upper_[1].data(), upper_[2].data()};
    for (std::uint32_t n = 0; n < on_face; ++n) {
        const std::uint32_t v = face_list[n];
        const unsigned faces = faces_of(v);
        std::uint32_t number = first + fresh;
        fresh_list[fresh] = v;
        fresh += (faces & 7) == 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const bool is_known = (faces >> axis & 1) != 0;
            number = is_known ? *known[axis] : number;
            known[axis] += is_known;
        }
        numbers[v] = number;
        for (unsigned axis = 0; axis < 3; ++axis) {
            *upper[axis] = number;
            upper[axis] += faces >> (3 + axis) & 1;
        }
    }
    return {fresh, {upper[0], upper[1], upper[2]}};
}

void PatchWeld::append(const PatchView& patch, std::size_t fresh) {
    // Assemble in small buffers that stay in cache, then append in one step.
    vertices_.resize(fresh);
    normals_.resize(fresh);
    tissue_.resize(fresh);
    const std::uint32_t *fresh_list = fresh_.data(), *numbers = number_.data();
    for (std::size_t n = 0; n < fresh; ++n) {
        const SurfaceVertex& vertex = patch.vertices[fresh_list[n]];
        vertices_[n] = {vertex.position[0], vertex.position[1], vertex.position[2]};
        normals_[n] = {vertex.normal[0], vertex.normal[1], vertex.normal[2]};
        tissue_[n] = patch.tissue[fresh_list[n]];
    }
    triangles_.resize(patch.triangles.size());
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
        const auto& [a, b, c] = patch.triangles[t];
        triangles_[t] = {numbers[a], numbers[b], numbers[c]};
    }
    const auto add_to = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    add_to(mesh_.vertices, vertices_);
    add_to(mesh_.normals, normals_);
    add_to(mesh_.tissue, tissue_);
    add_to(mesh_.triangles, triangles_);
}

}  // namespace kerf
