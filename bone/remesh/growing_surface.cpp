// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/growing_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace kerf::bone {
namespace {

double component(Vec3 v, std::size_t axis) noexcept { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Returns the number of fans of faces around a vertex: 1 where the surface is a disc.
std::size_t fans_at(std::uint32_t vertex, const std::vector<Triangle>& around) {
    // Each face leads from one neighbour of the vertex to the next; a fan is a chain of faces.
    std::size_t starts = 0;
    bool is_ring = !around.empty();
    for (const Triangle& t : around) {
        const std::size_t at = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
        const std::uint32_t from = t[(at + 1) % 3];
        const bool is_led_to = std::any_of(around.begin(), around.end(), [&](const Triangle& other) {
            const std::size_t there = other[0] == vertex ? 0 : other[1] == vertex ? 1 : 2;
            return other[(there + 2) % 3] == from;
        });
        if (is_led_to) continue;
        ++starts;
        is_ring = false;
    }
    return is_ring ? 1 : starts;
}

}  // namespace

GrowingSurface::GrowingSurface(const TaggedMesh& mesh)
    : bounds_(mesh.mesh.vertices.empty() ? Box{} : bounds_of(mesh.mesh)) {
    constexpr double faces_a_cell = 4.0, max_cells = 8e6;
    const Vec3 extent = bounds_.high - bounds_.low;
    const double area = area_of(mesh.mesh),
                 count = static_cast<double>(std::max<std::size_t>(mesh.mesh.triangles.size(), 1));
    // A cell is as wide as a few faces of average area. The number of cells is limited by memory.
    cell_ = std::max({std::sqrt(faces_a_cell * area / count), std::cbrt(extent.x * extent.y * extent.z / max_cells),
                      std::max({extent.x, extent.y, extent.z}) / 1000.0, 1e-6});
    std::size_t all = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cells_[axis] = static_cast<std::size_t>(component(extent, axis) / cell_) + 1;
        all *= cells_[axis];
    }
    in_cell_.resize(all);
    for (const Vec3 v : mesh.mesh.vertices) vertices_.push_back(v);
    faces_at_.resize(vertices_.size());
    for (std::size_t f = 0; f < mesh.mesh.triangles.size(); ++f) add_face(mesh.mesh.triangles[f], mesh.tags[f]);
}

Box GrowingSurface::box_of(std::uint32_t face) const noexcept {
    const Triangle& t = faces_[face].corners;
    const Vec3 a = vertices_[t[0]], b = vertices_[t[1]], c = vertices_[t[2]];
    return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
            {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

template <class Visit>
void GrowingSurface::for_each_cell(const Box& box, const Visit& visit) const {
    std::array<std::size_t, 3> from{}, to{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = component(bounds_.low, axis), last = static_cast<double>(cells_[axis] - 1);
        from[axis] = static_cast<std::size_t>(std::clamp((component(box.low, axis) - low) / cell_, 0.0, last));
        to[axis] = static_cast<std::size_t>(std::clamp((component(box.high, axis) - low) / cell_, 0.0, last));
    }
    for (std::size_t k = from[2]; k <= to[2]; ++k)
        for (std::size_t j = from[1]; j <= to[1]; ++j)
            for (std::size_t i = from[0]; i <= to[0]; ++i) visit((k * cells_[1] + j) * cells_[0] + i);
}

void GrowingSurface::add_face(const Triangle& corners, std::uint8_t tag) {
    std::uint32_t face = static_cast<std::uint32_t>(faces_.size());
    if (!free_faces_.empty()) {
        face = free_faces_.back();
        free_faces_.pop_back();
        faces_.set(face, {corners, tag, 1});
    } else {
        faces_.push_back({corners, tag, 1});
        seen_.push_back(0);
    }
    enter(face);
    ++face_count_;
}

void GrowingSurface::remove_face(std::uint32_t face) {
    strike(face);
    faces_.set(face, {});
    free_faces_.push_back(face);
    --face_count_;
}

void GrowingSurface::enter(std::uint32_t face) {
    for (const std::uint32_t v : faces_[face].corners) faces_at_[v].push_back(face);
    for_each_cell(box_of(face), [&](std::size_t cell) { in_cell_[cell].push_back(face); });
}

void GrowingSurface::strike(std::uint32_t face) {
    const auto drop = [face](std::vector<std::uint32_t>& from) {
        from.erase(std::find(from.begin(), from.end(), face));
    };
    for_each_cell(box_of(face), [&](std::size_t cell) { drop(in_cell_[cell]); });
    for (const std::uint32_t v : faces_[face].corners) drop(faces_at_[v]);
}

GrowingSurface::Moment GrowingSurface::moment() {
    return {vertices_.snapshot(), faces_.snapshot(), face_count_, free_faces_, free_vertices_};
}

void GrowingSurface::restore(const Moment& moment) {
    const std::vector<std::size_t> pages = faces_.differing_pages(moment.faces);
    const auto for_each_face = [&](const auto& visit) {
        constexpr std::size_t page_size = PagedVector<Face>::page_size;
        for (const std::size_t page : pages)
            for (std::size_t f = page * page_size; f < std::min(faces_.size(), (page + 1) * page_size); ++f)
                if (faces_[f].is_there != 0) visit(static_cast<std::uint32_t>(f));
    };
    for_each_face([this](std::uint32_t face) { strike(face); });
    vertices_.restore(moment.vertices);
    faces_.restore(moment.faces);
    faces_at_.resize(vertices_.size());
    seen_.resize(faces_.size(), 0);
    for_each_face([this](std::uint32_t face) { enter(face); });
    face_count_ = moment.face_count;
    free_faces_ = moment.free_faces;
    free_vertices_ = moment.free_vertices;
}

SurfacePatch GrowingSurface::patch_in(const Box& box) const {
    SurfacePatch patch;
    ++search_;
    const auto take = [&](std::uint32_t face) {
        if (seen_[face] == search_) return;
        seen_[face] = search_;
        patch.faces.push_back(face);
    };
    for_each_cell(box, [&](std::size_t cell) {
        for (const std::uint32_t face : in_cell_[cell])
            if (seen_[face] != search_ && meet(box_of(face), box)) take(face);
    });
    // If the border meets itself in a vertex, all faces around that vertex are added. Rounds make the result
    // independent of the order of the faces.
    for (std::vector<std::uint32_t> pinched(1); !pinched.empty();) {
        pinched.clear();
        for (const std::uint32_t face : patch.faces)
            for (const std::uint32_t v : faces_[face].corners) {
                std::vector<Triangle> taken;
                for (const std::uint32_t other : faces_at_[v])
                    if (seen_[other] == search_) taken.push_back(faces_[other].corners);
                if (taken.size() < faces_at_[v].size() && fans_at(v, taken) > 1) pinched.push_back(v);
            }
        for (const std::uint32_t v : pinched)
            for (const std::uint32_t face : faces_at_[v]) take(face);
    }
    std::sort(patch.faces.begin(), patch.faces.end());
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    for (const std::uint32_t face : patch.faces) {
        Triangle t = faces_[face].corners;
        for (std::uint32_t& corner : t) {
            const auto [place, is_new] = numbers.try_emplace(corner, static_cast<std::uint32_t>(numbers.size()));
            if (is_new) {
                patch.vertices.push_back(corner);
                patch.mesh.mesh.vertices.push_back(vertices_[corner]);
                patch.locked.push_back(std::any_of(faces_at_[corner].begin(), faces_at_[corner].end(),
                                                   [&](std::uint32_t f) { return seen_[f] != search_; }));
            }
            corner = place->second;
        }
        patch.mesh.mesh.triangles.push_back(t);
        patch.mesh.tags.push_back(faces_[face].tag);
    }
    return patch;
}

TaggedMesh GrowingSurface::ring_of(const SurfacePatch& patch) const {
    TaggedMesh ring;
    ++search_;
    for (const std::uint32_t face : patch.faces) seen_[face] = search_;
    for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
        if (patch.locked[v] == 0) continue;
        for (const std::uint32_t face : faces_at_[patch.vertices[v]]) {
            if (seen_[face] == search_) continue;
            seen_[face] = search_;
            const auto first = static_cast<std::uint32_t>(ring.mesh.vertices.size());
            for (const std::uint32_t corner : faces_[face].corners) ring.mesh.vertices.push_back(vertices_[corner]);
            ring.mesh.triangles.push_back({first, first + 1, first + 2});
            ring.tags.push_back(faces_[face].tag);
        }
    }
    return ring;
}

void GrowingSurface::replace(const SurfacePatch& patch, const TaggedMesh& mesh) {
    const auto less = [](Vec3 a, Vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; };
    std::map<Vec3, std::uint32_t, decltype(less)> known(less);
    for (std::size_t v = 0; v < patch.vertices.size(); ++v)
        known.emplace(patch.mesh.mesh.vertices[v], patch.vertices[v]);
    for (const std::uint32_t face : patch.faces) remove_face(face);
    std::vector<std::uint32_t> numbers;
    for (const Vec3 v : mesh.mesh.vertices) {
        const auto [place, is_new] = known.try_emplace(v, 0);
        if (is_new) {
            if (!free_vertices_.empty()) {
                place->second = free_vertices_.back();
                free_vertices_.pop_back();
                vertices_.set(place->second, v);
            } else {
                place->second = static_cast<std::uint32_t>(vertices_.size());
                vertices_.push_back(v);
                faces_at_.emplace_back();
            }
        }
        numbers.push_back(place->second);
    }
    for (std::size_t f = 0; f < mesh.mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.mesh.triangles[f];
        add_face({numbers[t[0]], numbers[t[1]], numbers[t[2]]}, mesh.tags[f]);
    }
    for (const std::uint32_t v : patch.vertices)
        if (faces_at_[v].empty()) free_vertices_.push_back(v);
}

TaggedMesh GrowingSurface::mesh() const {
    TaggedMesh all;
    std::vector<std::uint32_t> numbers(vertices_.size(), no_face);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        if (faces_[f].is_there == 0) continue;
        Triangle t = faces_[f].corners;
        for (std::uint32_t& corner : t) {
            if (numbers[corner] == no_face) {
                numbers[corner] = static_cast<std::uint32_t>(all.mesh.vertices.size());
                all.mesh.vertices.push_back(vertices_[corner]);
            }
            corner = numbers[corner];
        }
        all.mesh.triangles.push_back(t);
        all.tags.push_back(faces_[f].tag);
    }
    return all;
}

}  // namespace kerf::bone
