// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bone/surface/surface_mesh.h"
#include "bone/surface/triangle_distance.h"

namespace kerf::bone {

/// Triangles in a tree of boxes, for distances, rays and winding numbers. The same mesh gives the same tree and the
/// same bits. Unit and frame: the mesh's.
class TriangleTree {
public:
    explicit TriangleTree(const SurfaceMesh& mesh);

    /// Returns the distance to the nearest triangle if it is less than `limit`; otherwise `limit`. Exact up to
    /// rounding. Faces without area count as segments or points.   [any] pure.
    [[nodiscard]] double distance(Vec3 p, double limit) const noexcept;

    /// Returns the winding number of the surface around a point: 1 inside a closed surface, 0 outside, more where it
    /// overlaps itself; in between near a hole.
    ///
    ///     w = Σ Ω_t / 4π,  Ω_t the solid angle of triangle t
    ///
    /// A far group of triangles counts as one dipole: accurate to 0.25 between close walls, otherwise to 0.05.   [any]
    /// pure.
    /// Source: [barill-2018], with the expansion of first order.
    [[nodiscard]] double winding(Vec3 p) const noexcept;
    /// Returns the winding number summed triangle by triangle.
    [[nodiscard]] double exact_winding(Vec3 p) const noexcept;
    /// Returns whether a point is inside: w > ½. Between ¼ and ¾ the exact sum decides. So in a closed surface an error
    /// of the fast sum below ¾ has no effect.   [any] pure.
    [[nodiscard]] bool is_inside(Vec3 p) const noexcept;

    struct Hit {
        double distance = 0.0;   ///< along the ray, in lengths of `direction`
        std::uint32_t face = 0;  ///< number in the mesh
    };
    /// Returns the first triangle beyond `from` along a ray, other than `ignored`.   [any] pure.
    [[nodiscard]] std::optional<Hit> first_hit(Vec3 origin, Vec3 direction, double from,
                                               std::uint32_t ignored) const noexcept;

    /// Calls visit(a, b, c) with the corners of every triangle at most `radius` from p, and of some others.
    template <class Visit>
    void for_each_within(Vec3 p, double radius, const Visit& visit) const {
        if (!nodes_.empty()) within(0, p, radius * radius, visit);
    }

    /// Calls visit(face, other) for all pairs of triangles whose boxes meet, face < other.
    template <class Visit>
    void for_each_near_pair(const Visit& visit) const {
        if (!nodes_.empty()) pairs(0, 0, visit);
    }

private:
    struct Node {
        Vec3 low, high;
        std::uint32_t first = 0, count = 0;  ///< of `items_`; both children of an inner node follow it
        std::uint32_t second_child = 0;      ///< the first one follows directly; 0: a leaf
        Vec3 area{};                         ///< Σ area × normal
        Vec3 centre{};                       ///< of area
        double radius = 0.0;                 ///< around `centre`
    };
    struct Item {
        Vec3 a, b, c;
        std::uint32_t face = 0;
    };
    static constexpr std::uint32_t max_in_leaf = 4;

    void build(std::uint32_t first, std::uint32_t count);
    [[nodiscard]] static bool meet(const Node& a, const Node& b) noexcept {
        return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
               a.low.z <= b.high.z && b.low.z <= a.high.z;
    }
    [[nodiscard]] static bool meet(const Item& a, const Item& b) noexcept;

    template <class Visit>
    void within(std::uint32_t n, Vec3 p, double squared_radius, const Visit& visit) const {
        const Node& node = nodes_[n];
        if (squared_to_box(p, node.low, node.high) > squared_radius) return;
        if (node.second_child == 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                visit(items_[i].a, items_[i].b, items_[i].c);
            return;
        }
        within(n + 1, p, squared_radius, visit);
        within(node.second_child, p, squared_radius, visit);
    }

    template <class Visit>
    void pairs(std::uint32_t m, std::uint32_t n, const Visit& visit) const {
        const Node &a = nodes_[m], &b = nodes_[n];
        if (!meet(a, b)) return;
        const bool a_is_leaf = a.second_child == 0, b_is_leaf = b.second_child == 0;
        if (a_is_leaf && b_is_leaf) {
            for (std::uint32_t i = a.first; i < a.first + a.count; ++i)
                for (std::uint32_t j = m == n ? i + 1 : b.first; j < b.first + b.count; ++j)
                    if (meet(items_[i], items_[j]))
                        visit(std::min(items_[i].face, items_[j].face), std::max(items_[i].face, items_[j].face));
        } else if (m == n) {
            pairs(m + 1, m + 1, visit);
            pairs(a.second_child, a.second_child, visit);
            pairs(m + 1, a.second_child, visit);
        } else if (b_is_leaf || (!a_is_leaf && a.count >= b.count)) {
            pairs(m + 1, n, visit);
            pairs(a.second_child, n, visit);
        } else {
            pairs(m, n + 1, visit);
            pairs(m, b.second_child, visit);
        }
    }

    std::vector<Node> nodes_;
    std::vector<Item> items_;
};

}  // namespace kerf::bone
