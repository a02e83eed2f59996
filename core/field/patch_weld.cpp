// SPDX-License-Identifier: Apache-2.0
#include "core/field/patch_weld.h"

#include "kerf/assert.hpp"

namespace kerf {

namespace {

/// On which of a brick's faces a place lies: bits 0 … 2 on the lower ones, 3 … 5 on the upper ones.
constexpr std::array<std::uint8_t, 10 * place_layer> faces_of_place = [] {
    std::array<std::uint8_t, 10 * place_layer> faces{};
    for (std::size_t place = 0; place < faces.size(); ++place)
        for (unsigned axis = 0; axis < 3; ++axis) {
            const std::size_t at = place >> 4 * axis & 15;
            if (at == 1) faces[place] = static_cast<std::uint8_t>(faces[place] | 1U << axis);
            if (at == 9) faces[place] = static_cast<std::uint8_t>(faces[place] | 8U << axis);
        }
    return faces;
}();

}  // namespace

PatchWeld::PatchWeld(const Grid& grid, std::size_t vertices, std::size_t triangles) : grid_(grid), first_shared_(grid.brick_count()) {
    mesh_.vertices.reserve(vertices);
    mesh_.normals.reserve(vertices);
    mesh_.tissue.reserve(vertices);
    mesh_.triangles.reserve(triangles);
}

void PatchWeld::add(std::size_t brick, const PatchView& patch) {
    const std::size_t row = static_cast<std::size_t>(grid_.bricks[0]), layer = row * static_cast<std::size_t>(grid_.bricks[1]);
    const std::array<bool, 3> has_lower{brick % row != 0, brick % layer >= row, brick >= layer};
    const std::array<std::size_t, 3> below{1, row, layer};

    // Vertices on a lower face have numbers already, in the order in which they come here too.
    static constexpr std::uint32_t none = 0;
    std::array<const std::uint32_t*, 3> known;
    unsigned lower_faces = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        known[axis] = has_lower[axis] && !shared_.empty() ? shared_.data() + first_shared_[brick - below[axis]][axis] : &none;
        lower_faces |= unsigned{has_lower[axis]} << axis;
    }

    const std::size_t count = patch.vertices.size(), first = mesh_.vertices.size();
    mesh_.vertices.resize(first + count);
    mesh_.normals.resize(first + count);
    mesh_.tissue.resize(first + count);
    number_.resize(count);
    for (auto& upper : upper_) upper.resize(count);
    Vec3 *vertices = mesh_.vertices.data(), *normals = mesh_.normals.data();
    std::uint8_t* tissue = mesh_.tissue.data();
    std::array<std::uint32_t*, 3> upper{upper_[0].data(), upper_[1].data(), upper_[2].data()};
    auto next = static_cast<std::uint32_t>(first);
    for (std::size_t v = 0; v < count; ++v) {
        const unsigned axis = patch.edges[v] >> 12;
        const unsigned faces = faces_of_place[patch.edges[v] & 0xfff] & ~(9U << axis) & (lower_faces | 0x38);
        const SurfaceVertex& vertex = patch.vertices[v];
        vertices[next] = {vertex.position[0], vertex.position[1], vertex.position[2]};
        normals[next] = {vertex.normal[0], vertex.normal[1], vertex.normal[2]};
        tissue[next] = patch.tissue[v];
        std::uint32_t number = next;
        for (unsigned n = 0; n < 3; ++n) {
            const bool is_known = (faces >> n & 1) != 0;
            number = is_known ? *known[n] : number;
            known[n] += is_known;
        }
        next += (faces & 7) == 0;
        number_[v] = number;
        for (unsigned n = 0; n < 3; ++n) {
            *upper[n] = number;
            upper[n] += faces >> (3 + n) & 1;
        }
    }
    mesh_.vertices.resize(next);
    mesh_.normals.resize(next);
    mesh_.tissue.resize(next);

    for (std::size_t axis = 0; axis < 3; ++axis) {
        first_shared_[brick][axis] = static_cast<std::uint32_t>(shared_.size());
        shared_.insert(shared_.end(), upper_[axis].data(), upper[axis]);
    }
    shared_.push_back(none);  // so that who reads one too many reads something

    const std::size_t triangle = mesh_.triangles.size();
    mesh_.triangles.resize(triangle + patch.triangles.size());
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
        const auto& [a, b, c] = patch.triangles[t];
        mesh_.triangles[triangle + t] = {number_[a], number_[b], number_[c]};
    }
}

}  // namespace kerf
