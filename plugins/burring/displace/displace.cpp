// SPDX-License-Identifier: Apache-2.0
#include "displace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "half_edges.h"
#include "refine.h"
#include "tidy.h"

namespace kerf::burring::displacement {
namespace {

constexpr std::uint32_t none = 0xffffffffu;
constexpr std::size_t max_faces = 2'000'000;
constexpr std::size_t max_attempts = 4;  // one source for each attempt

struct FaceCorners {
    std::array<std::uint32_t, 3> numbers;
    Vec3 a, b, c;
};
FaceCorners corners_of(const Triangles& mesh, std::size_t f) {
    const auto& t = mesh.triangles;
    return {{t[3 * f], t[3 * f + 1], t[3 * f + 2]},
            mesh.vertices[t[3 * f]],
            mesh.vertices[t[3 * f + 1]],
            mesh.vertices[t[3 * f + 2]]};
}

/// Position of a vertex relative to the burr's surface.
enum class Side : std::int8_t { inside = -1, on = 0, outside = 1 };

/// One cut of one mesh.
class Displacement {
public:
    Displacement(Triangles& mesh, const std::vector<std::uint8_t>& locked, const SweptBurr& burr, double tolerance)
        : mesh_(&mesh),
          locked_(&locked),
          burr_(&burr),
          fineness_(Fineness::of(tolerance, burr.largest_radius())),
          deep_(0.5 * tolerance),
          count_(mesh.vertices.size()) {}

    Outcome run(const Cancelled& cancelled, std::string& why) {
        for (const auto& [a, b] : border_of(*mesh_))
            if (is_met(mesh_->vertices[a], mesh_->vertices[b], 0.5 * (mesh_->vertices[a] + mesh_->vertices[b]),
                       deep_)) {
                why = "the burr reaches the border of the patch";
                return Outcome::declined;
            }
        if (!split_near_burr()) {
            why = "the surface near the burr would have more than " + std::to_string(max_faces) + " faces";
            return Outcome::declined;
        }
        if (cancelled()) return Outcome::cancelled;
        find_sides();
        if (std::find(sides_.begin(), sides_.end(), Side::inside) == sides_.end()) return Outcome::unchanged;
        for (std::size_t v = 0; v < locked_->size(); ++v)
            if ((*locked_)[v] != 0 && sides_[v] == Side::inside) {
                why = "the burr reaches a locked vertex";
                return Outcome::declined;
            }
        if (!split_at_rim()) {
            why = "the mesh is not 2-manifold";
            return Outcome::refused;
        }
        const std::vector<std::uint8_t> is_inside = faces_inside();
        const std::vector<Source> sources = sources_of(is_inside);
        why = "inside the swept burr the surface does not look at its axis everywhere: another wall is in the way";
        Outcome moved = Outcome::declined;
        for (std::size_t n = 0; n < std::min(sources.size(), max_attempts) && moved == Outcome::declined; ++n) {
            std::vector<std::uint32_t> numbers;
            Triangles wall = taken(is_inside, numbers);
            moved = move_onto_burr(wall, *burr_, sources[n], fineness_, cancelled, why);
            if (moved == Outcome::cut) put_back(wall, numbers, is_inside);
        }
        return moved;
    }

private:
    /// Returns whether the burr reaches more than `deep` [m] into a face.
    [[nodiscard]] bool is_met(Vec3 a, Vec3 b, Vec3 c, double deep) const {
        const Vec3 middle = (a + b + c) / 3.0;
        const double reach = std::max({length(a - middle), length(b - middle), length(c - middle)});
        double lower_bound = 0.0, at_middle = 0.0;
        if (burr_->is_nearly_straight()) {
            const SweptBurr::Bound bound = burr_->outside_lower_bound(middle);
            const auto at = [&](Vec3 p) { return bound.at + dot(bound.slope, p - middle); };
            at_middle = bound.at;
            lower_bound = std::min({at(a), at(b), at(c)});
        } else {
            at_middle = burr_->outside(middle);
            lower_bound = at_middle - reach;
        }
        if (at_middle < -deep) return true;
        if (lower_bound >= -deep || reach < 0.25 * fineness_.edge) return false;
        const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        return is_met(a, ab, ca, deep) || is_met(b, bc, ab, deep) || is_met(c, ca, bc, deep) ||
               is_met(ab, bc, ca, deep);
    }

    [[nodiscard]] bool split_near_burr() {
        const auto wants = [this](const Triangles& mesh, std::uint32_t f, double longest) {
            const auto [numbers, a, b, c] = corners_of(mesh, f);
            // An earlier wall may be off its own burr by this much.
            const double deep = mesh.tags[f] == KERF_FACE_SURFACE ? deep_ : 1.5 * fineness_.tolerance;
            return longest > fineness_.edge && is_met(a, b, c, deep);
        };
        return refine(
            *mesh_, wants, [](Vec3 a, Vec3 b) { return 0.5 * (a + b); }, max_faces);
    }

    void find_sides() {
        const double just_inside = std::max(0.02 * fineness_.tolerance, 1e-8);
        // A vertex of an earlier wall lies on the burr of that cut. A face from there to this burr has a smaller error.
        std::vector<double> just_outside(mesh_->vertices.size(), fineness_.tolerance);
        for (std::size_t f = 0; f < mesh_->tags.size(); ++f)
            if (mesh_->tags[f] == KERF_FACE_SURFACE)
                for (const std::uint32_t v : corners_of(*mesh_, f).numbers)
                    just_outside[v] = 0.25 * fineness_.tolerance;
        std::vector<double> outside;
        for (std::size_t v = 0; v < mesh_->vertices.size(); ++v) {
            const double x = outside.emplace_back(burr_->outside(mesh_->vertices[v]));
            sides_.push_back(x < -just_inside ? Side::inside : x > just_outside[v] ? Side::outside : Side::on);
        }
        forget_shallow(outside);
    }
    /// Connected inside vertices that are nowhere deep count as on the surface.
    void forget_shallow(const std::vector<double>& outside) {
        std::vector<std::uint32_t> leader(sides_.size());
        for (std::uint32_t v = 0; v < leader.size(); ++v) leader[v] = v;
        const auto find = [&](std::uint32_t v) {
            while (leader[v] != v) v = leader[v] = leader[leader[v]];
            return v;
        };
        for (std::size_t f = 0; f < mesh_->tags.size(); ++f) {
            const auto numbers = corners_of(*mesh_, f).numbers;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = numbers[i], b = numbers[(i + 1) % 3];
                if (sides_[a] == Side::inside && sides_[b] == Side::inside) leader[find(b)] = find(a);
            }
        }
        std::vector<double> deepest(sides_.size(), 0.0);
        for (std::uint32_t v = 0; v < sides_.size(); ++v)
            if (sides_[v] == Side::inside) deepest[find(v)] = std::min(deepest[find(v)], outside[v]);
        for (std::uint32_t v = 0; v < sides_.size(); ++v)
            if (sides_[v] == Side::inside && deepest[find(v)] > -deep_) sides_[v] = Side::on;
    }

    /// Splits each edge that crosses the burr's surface at its crossing point.
    [[nodiscard]] bool split_at_rim() {
        HalfEdges half_edges;
        FaceTags tags;
        if (!load(*mesh_, half_edges, tags)) return false;
        const std::size_t count = half_edges.n_edges();
        for (std::size_t n = 0; n < count; ++n) {
            const auto edge = half_edges.edge_handle(static_cast<unsigned>(n));
            const auto h = half_edges.halfedge_handle(edge, 0);
            auto a = half_edges.from_vertex_handle(h), b = half_edges.to_vertex_handle(h);
            if (side_of(a) == Side::outside) std::swap(a, b);
            if (side_of(a) != Side::inside || side_of(b) != Side::outside) continue;
            const Vec3 rim = burr_->crossing(position(half_edges, a), position(half_edges, b));
            half_edges.split_copy(edge, half_edges.add_vertex(point_of(rim)));
            sides_.push_back(Side::on);
        }
        *mesh_ = faces_of(half_edges, tags);
        return true;
    }
    [[nodiscard]] Side side_of(HalfEdges::VertexHandle v) const { return sides_[static_cast<std::size_t>(v.idx())]; }

    /// Pre: no edge crosses the burr's surface.
    [[nodiscard]] std::vector<std::uint8_t> faces_inside() const {
        std::vector<std::uint8_t> is_inside;
        for (std::size_t f = 0; f < mesh_->tags.size(); ++f) {
            const auto [numbers, a, b, c] = corners_of(*mesh_, f);
            const auto has = [&, n = numbers](Side side) {
                return std::any_of(n.begin(), n.end(), [&](std::uint32_t v) { return sides_[v] == side; });
            };
            const bool is_bridge =
                !has(Side::inside) && !has(Side::outside) && burr_->outside((a + b + c) / 3.0) < -fineness_.tolerance;
            is_inside.push_back(has(Side::inside) || is_bridge);
        }
        return is_inside;
    }

    /// Returns the sources that all faces inside face. Points come first, because no face turns over along rays from a
    /// point. Then come the sources that the faces face at the best angle.
    [[nodiscard]] std::vector<Source> sources_of(const std::vector<std::uint8_t>& is_inside) const {
        constexpr double min_needed = 0.01;  // [–] the sine of an angle
        struct Rated {
            bool is_point;
            double least;
            Source source;
        };
        std::vector<Rated> found;
        for (const Source& source : burr_->sources()) {
            double least = 1.0;
            for (std::size_t f = 0; f < is_inside.size() && least > min_needed; ++f) {
                if (is_inside[f] == 0) continue;
                const auto [numbers, a, b, c] = corners_of(*mesh_, f);
                const Vec3 across = cross(b - a, c - a), normal = normalized(across);
                // The normal of a sliver means nothing. It turns with its neighbour.
                if (length(across) < fineness_.tolerance * std::max({length(b - a), length(c - b), length(a - c)}))
                    continue;
                for (const Vec3 p : {a, b, c, (a + b + c) / 3.0})
                    least = std::min(least, dot(normal, normalized(source.nearest(p) - p)));
            }
            if (least > min_needed) found.push_back({source.from == source.to, least, source});
        }
        std::stable_sort(found.begin(), found.end(), [](const Rated& a, const Rated& b) {
            return a.is_point != b.is_point ? a.is_point : a.least > b.least;
        });
        std::vector<Source> sources;
        for (const Rated& one : found) sources.push_back(one.source);
        return sources;
    }

    /// Returns the faces inside as a separate mesh; `numbers` receives the numbers of their vertices in the whole mesh.
    [[nodiscard]] Triangles taken(const std::vector<std::uint8_t>& is_inside,
                                  std::vector<std::uint32_t>& numbers) const {
        Triangles wall;
        std::vector<std::uint32_t> own(mesh_->vertices.size(), none);
        for (std::size_t f = 0; f < is_inside.size(); ++f) {
            if (is_inside[f] == 0) continue;
            for (const std::uint32_t v : corners_of(*mesh_, f).numbers) {
                if (own[v] == none) {
                    own[v] = static_cast<std::uint32_t>(numbers.size());
                    numbers.push_back(v);
                    wall.vertices.push_back(mesh_->vertices[v]);
                }
                wall.triangles.push_back(own[v]);
            }
            wall.tags.push_back(KERF_FACE_WALL);
        }
        return wall;
    }
    /// Replaces the faces inside by a wall, removes slivers next to it, and drops unused vertices.
    void put_back(const Triangles& wall, std::vector<std::uint32_t> numbers,
                  const std::vector<std::uint8_t>& is_inside) {
        for (std::size_t v = 0; v < wall.vertices.size(); ++v) {
            if (v < numbers.size()) {
                mesh_->vertices[numbers[v]] = wall.vertices[v];
            } else {
                numbers.push_back(static_cast<std::uint32_t>(mesh_->vertices.size()));
                mesh_->vertices.push_back(wall.vertices[v]);
            }
        }
        Triangles whole;
        for (std::size_t f = 0; f < is_inside.size(); ++f) {
            if (is_inside[f] != 0) continue;
            for (const std::uint32_t v : corners_of(*mesh_, f).numbers) whole.triangles.push_back(v);
            whole.tags.push_back(mesh_->tags[f]);
        }
        for (const std::uint32_t v : wall.triangles) whole.triangles.push_back(numbers[v]);
        whole.tags.insert(whole.tags.end(), wall.tags.begin(), wall.tags.end());
        whole.vertices = std::move(mesh_->vertices);
        *mesh_ = std::move(whole);

        std::vector<std::uint8_t> stays = *locked_, is_new(mesh_->vertices.size(), 1);
        stays.resize(is_new.size(), 0);
        std::fill_n(is_new.begin(), count_, std::uint8_t{0});
        tidy(*mesh_, stays, is_new, {1e-9, 0.1 * fineness_.tolerance, 0.5 * fineness_.tolerance});
        drop_unused();
    }
    void drop_unused() {
        std::vector<Vec3> used;
        std::vector<std::uint32_t> own(mesh_->vertices.size(), none);
        for (std::uint32_t& v : mesh_->triangles) {
            if (own[v] == none) {
                own[v] = static_cast<std::uint32_t>(used.size());
                used.push_back(mesh_->vertices[v]);
            }
            v = own[v];
        }
        mesh_->vertices = std::move(used);
    }

    Triangles* mesh_;
    const std::vector<std::uint8_t>* locked_;
    const SweptBurr* burr_;
    Fineness fineness_;
    double deep_;        ///< [m]
    std::size_t count_;  ///< vertices before the cut
    std::vector<Side> sides_;
};

}  // namespace

Outcome displace(Triangles& mesh, const std::vector<std::uint8_t>& locked, const SweptBurr& burr, double tolerance,
                 const Cancelled& cancelled, std::string& why) {
    return Displacement(mesh, locked, burr, tolerance).run(cancelled, why);
}

}  // namespace kerf::burring::displacement
