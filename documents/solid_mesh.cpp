// SPDX-License-Identifier: Apache-2.0
#include "documents/solid_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "documents/solids.h"
#include "documents/superquadric.h"

namespace kerf::documents {
namespace {

constexpr std::uint32_t sides = 32;
constexpr double whole_turn = 6.283185307179586;  // [rad]

/// Returns cosine and sine of a part of a whole turn, the same bits on every machine.
Vec3 on_circle(double part) noexcept { return rotate(quat_from_rotation_vector({0, 0, part * whole_turn}), {1, 0, 0}); }

std::uint32_t add_vertex(Vec3 at, Vec3 normal, Mesh& mesh) {
    mesh.vertices.push_back(at);
    mesh.normals.push_back(normal);
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add(const BoxSolid& box, Mesh& mesh) {
    const Vec3 middle = box.centre, half = 0.5 * box.size;
    const Vec3 axes[3]{{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            const Vec3 out = sign * axes[axis], a = axes[(axis + 1) % 3], b = sign * axes[(axis + 2) % 3];
            const Vec3 normal = normalized(out);
            const std::uint32_t first = add_vertex(middle + out - a - b, normal, mesh);
            add_vertex(middle + out + a - b, normal, mesh);
            add_vertex(middle + out + a + b, normal, mesh);
            add_vertex(middle + out - a + b, normal, mesh);
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangles.push_back({first, first + 2, first + 3});
        }
}

/// Adds a tube around `from` … `to`. `side` and `up` are its half axes, at right angles to it and to each other.
void add_tube(Vec3 from, Vec3 to, Vec3 side, Vec3 up, Mesh& mesh) {
    const Vec3 along = normalized(to - from);
    if (dot(cross(side, up), along) < 0.0) side = Vec3{} - side;
    const double rx = length(side), ry = length(up);
    if (rx <= 0.0 || ry <= 0.0) return;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t i = 0; i < sides; ++i) {
        const Vec3 c = on_circle(static_cast<double>(i) / sides);
        const Vec3 out = c.x * side + c.y * up;
        const Vec3 normal = normalized((c.x / (rx * rx)) * side + (c.y / (ry * ry)) * up);
        add_vertex(from + out, normal, mesh);
        add_vertex(to + out, normal, mesh);
        add_vertex(from + out, Vec3{} - along, mesh);
        add_vertex(to + out, along, mesh);
    }
    const std::uint32_t low = add_vertex(from, Vec3{} - along, mesh), high = add_vertex(to, along, mesh);
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = first + 4 * i, b = first + 4 * ((i + 1) % sides);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
        mesh.triangles.push_back({low, b + 2, a + 2});
        mesh.triangles.push_back({high, a + 3, b + 3});
    }
}

void add(const TubeSolid& tube, Mesh& mesh) {
    const Vec3 along = normalized(tube.to - tube.from);
    const Vec3 side = normalized(cross(along, std::abs(along.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
    add_tube(tube.from, tube.to, tube.radius * side, tube.radius * cross(along, side), mesh);
}

void add(const EllipticTubeSolid& tube, Mesh& mesh) {
    const Vec3 along = normalized(tube.to - tube.from);
    const Vec3 up = normalized(tube.up - dot(tube.up, along) * along);
    add_tube(tube.from, tube.to, 0.5 * tube.width * cross(up, along), 0.5 * tube.height * up, mesh);
}

/// Adds rings of a closed surface. `point` and `normal` map a direction onto them.
template <class Point, class Normal>
void add_ball(const Point& point, const Normal& normal, Mesh& mesh) {
    constexpr std::uint32_t rings = sides / 2;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        const Vec3 slope = on_circle(0.5 * ring / rings);  // from the lowest point to the highest
        for (std::uint32_t i = 0; i < sides; ++i) {
            const Vec3 c = on_circle(static_cast<double>(i) / sides);
            const Vec3 out = normalized(Vec3{slope.y * c.x, slope.y * c.y, -slope.x});
            add_vertex(point(out), normal(out), mesh);
        }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t a = first + ring * sides + i, b = first + ring * sides + (i + 1) % sides;
            if (ring > 0) mesh.triangles.push_back({a, b, b + sides});
            if (ring + 1 < rings) mesh.triangles.push_back({a, b + sides, a + sides});
        }
}

void add(const SphereSolid& sphere, Mesh& mesh) {
    add_ball([&](Vec3 out) { return sphere.centre + sphere.radius * out; }, [](Vec3 out) { return out; }, mesh);
}

void add(const SuperellipsoidSolid& solid, Mesh& mesh) {
    const SuperellipsoidAxes axes = axes_of(solid);
    const Superellipsoid shape{axes.half, solid.exponent};
    const auto in_bone = [&](Vec3 v) { return v.x * axes.side + v.y * axes.up + v.z * axes.along; };
    const auto on_surface = [&](Vec3 out) {
        const Vec3 scaled{out.x * shape.half.x, out.y * shape.half.y, out.z * shape.half.z};
        return (1.0 / shape.at(scaled).value) * scaled;
    };
    add_ball([&](Vec3 out) { return solid.centre + in_bone(on_surface(out)); },
             [&](Vec3 out) { return in_bone(normalized(shape.at(on_surface(out)).gradient)); }, mesh);
}

/// Returns how far the surface is inside of a flat end's corner, `from_end` before it [m].
double rounded_by(double rim, double from_end) noexcept {
    const double in_rim = std::max(0.0, rim - from_end);
    return rim - std::sqrt(std::max(0.0, rim * rim - in_rim * in_rim));
}

void add(const LoftSolid& loft, Mesh& mesh) {
    if (loft.path.empty()) return;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const double whole = loft.path.back().from_start;
    const auto on_ring = [&](std::size_t ring, std::uint32_t i) {
        const LoftFrame& frame = loft.path[ring];
        const double inset = rounded_by(loft.rim, std::min(frame.from_start, whole - frame.from_start));
        if (!loft.outlines.empty()) {
            const Outline& outline = loft.outlines[ring];
            const Vec3 p = outline[i * outline.size() / sides];
            const double left = std::max(0.0, 1.0 - inset / std::min(frame.half_width, frame.half_height));
            return frame.at + (left * p.x) * frame.side + (left * p.y) * frame.up;
        }
        const Vec3 c = on_circle(static_cast<double>(i) / sides);
        const auto stretched = [&](double x) { return std::copysign(std::pow(std::abs(x), 2.0 / frame.exponent), x); };
        const double y = stretched(c.y), x = stretched(c.x) * (1.0 - frame.taper * y);
        return frame.at + (x * std::max(0.0, frame.half_width - inset)) * frame.side +
               (y * std::max(0.0, frame.half_height - inset)) * frame.up;
    };
    const auto ring_count = static_cast<std::uint32_t>(loft.path.size());
    for (std::uint32_t ring = 0; ring < ring_count; ++ring)
        for (std::uint32_t i = 0; i < sides; ++i) add_vertex(on_ring(ring, i), {}, mesh);
    const std::uint32_t low = add_vertex(loft.path.front().at, {}, mesh),
                        high = add_vertex(loft.path.back().at, {}, mesh);
    // `side` × `up` is `along`: seen from the end, a ring runs anticlockwise.
    for (std::uint32_t ring = 0; ring + 1 < ring_count; ++ring)
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t a = first + ring * sides + i, b = first + ring * sides + (i + 1) % sides;
            mesh.triangles.push_back({a, b, b + sides});
            mesh.triangles.push_back({a, b + sides, a + sides});
        }
    const std::uint32_t last = first + (ring_count - 1) * sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
        mesh.triangles.push_back({low, first + (i + 1) % sides, first + i});
        mesh.triangles.push_back({high, last + i, last + (i + 1) % sides});
    }
    for (std::size_t t = mesh.triangles.size() - 2u * sides * ring_count; t < mesh.triangles.size(); ++t) {
        const auto& triangle = mesh.triangles[t];
        const Vec3 normal = cross(mesh.vertices[triangle[1]] - mesh.vertices[triangle[0]],
                                  mesh.vertices[triangle[2]] - mesh.vertices[triangle[0]]);
        for (const std::uint32_t corner : triangle) mesh.normals[corner] = mesh.normals[corner] + normal;
    }
    for (std::size_t v = first; v < mesh.vertices.size(); ++v) mesh.normals[v] = normalized(mesh.normals[v]);
}

}  // namespace

Mesh mesh_of(const std::vector<Solid>& solids) {
    Mesh mesh;
    for (const Solid& solid : solids) std::visit([&](const auto& one) { add(one, mesh); }, solid);
    return mesh;
}

}  // namespace kerf::documents
