// SPDX-License-Identifier: Apache-2.0
#include "app/window/shape_buffer.h"

#include <cmath>
#include <numbers>

namespace kerf::window {

namespace {

std::array<float, 3> single_array(Vec3 v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3 across(Vec3 axis) { return normalized(cross(axis, std::abs(axis.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})); }

}  // namespace

ShapeBuffer::ShapeBuffer(const run::ViewedMesh& mesh)
    : array_(make_vertex_array()),
      vertices_(make_buffer()),
      indices_(make_buffer()),
      count_(static_cast<GLsizei>(3 * mesh.triangles.size())) {
    const auto bytes = [](const auto& list) { return static_cast<GLsizeiptr>(sizeof(list[0]) * list.size()); };
    glBindVertexArray(array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.get());
    const GLsizeiptr positions = bytes(mesh.positions), normals = bytes(mesh.normals);
    glBufferData(GL_ARRAY_BUFFER, positions + normals, nullptr, GL_STATIC_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, positions, mesh.positions.data());
    glBufferSubData(GL_ARRAY_BUFFER, positions, normals, mesh.normals.data());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(mesh.triangles), mesh.triangles.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, reinterpret_cast<const void*>(positions));
    glBindVertexArray(0);
}

void ShapeBuffer::draw() const {
    if (count_ == 0) return;
    glBindVertexArray(array_.get());
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

run::ViewedMesh bar(Vec3 from, Vec3 to, double radius) {
    constexpr std::uint32_t sides = 10;
    run::ViewedMesh mesh;
    const Vec3 along = normalized(to - from), x = across(along), y = cross(along, x);
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / sides;
        const Vec3 out = std::cos(angle) * x + std::sin(angle) * y;
        for (const Vec3 end : {from, to}) {
            mesh.positions.push_back(single_array(end + radius * out));
            mesh.normals.push_back(single_array(out));
        }
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
    }
    return mesh;
}

run::ViewedMesh disc(Vec3 at, Vec3 normal, double radius) {
    constexpr std::uint32_t sides = 48;
    run::ViewedMesh mesh;
    const Vec3 x = across(normal), y = cross(normal, x);
    mesh.positions.push_back(single_array(at));
    mesh.normals.push_back(single_array(normal));
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / sides;
        mesh.positions.push_back(single_array(at + radius * (std::cos(angle) * x + std::sin(angle) * y)));
        mesh.normals.push_back(single_array(normal));
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
    }
    return mesh;
}

}  // namespace kerf::window
