// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The triangles in a cell of a grid, by the corners that are inside: the table of marching cubes.
///
/// Where a face of a cell is ambiguous, inside corners are kept apart: parts that touch only across a diagonal are two
/// pieces, as with 6-connectivity of the samples.
///
/// Source: [lorensen-1987]; the table is generated, not copied.
namespace kerf {

// Corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2 & 1). Its edge e runs along axis e / 4 from corner
// `edge_start[e]`; bit c of a case is 1 if corner c is inside.
inline constexpr int cell_corners = 8, cell_edges = 12, cell_case_count = 256;
inline constexpr int max_triangles = 5;  // with more, the table does not compile
inline constexpr std::array<int, cell_edges> edge_start{0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3};

struct CellCase {
    int count = 0;
    std::array<std::array<std::uint8_t, 3>, max_triangles>
        triangles{};  ///< each vertex by the cell's edge on which it lies
};

namespace detail {

constexpr int edge_between(int a, int b) {
    for (int e = 0; e < cell_edges; ++e) {
        const int start = edge_start[static_cast<std::size_t>(e)], end = start | 1 << (e / 4);
        if ((a == start && b == end) || (a == end && b == start)) return e;
    }
    return -1;
}

using Face = std::array<int, 4>;  // corners, anticlockwise seen from outside the cell

constexpr Face cell_face(int f) {
    const int axis = f / 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    const int base = f % 2 << axis;
    if (f % 2 == 0) return {base, base | v, base | u | v, base | u};
    return {base, base | u, base | u | v, base | v};
}

constexpr bool lie_on_one_face(int edge_a, int edge_b) {
    const auto touches = [](int edge, int axis, int side) {
        const int start = edge_start[static_cast<std::size_t>(edge)];
        return edge / 4 != axis && (start >> axis & 1) == side;
    };
    for (int f = 0; f < 6; ++f)
        if (touches(edge_a, f / 2, f % 2) && touches(edge_b, f / 2, f % 2)) return true;
    return false;
}

// The outline of a case on the cell's faces: next[e] is the edge after edge e, −1 if the outline does not cross e. On
// each face, one segment cuts off each run of inside corners, so opposite corners stay apart. Seen from outside the
// cell, a segment has the inside on its right. In the neighbouring cell it runs in the opposite direction.
constexpr std::array<int, cell_edges> outline(int inside) {
    std::array<int, cell_edges> next{};
    next.fill(-1);
    for (int f = 0; f < 6; ++f) {
        const Face face = cell_face(f);
        const auto corner = [&](int m) { return face[static_cast<std::size_t>(m % 4)]; };
        const auto is_inside = [&](int m) { return (inside >> corner(m) & 1) != 0; };
        for (int m = 0; m < 4; ++m) {
            if (is_inside(m) || !is_inside(m + 1)) continue;
            int last = m + 1;
            while (is_inside(last + 1)) ++last;
            const int enter = edge_between(corner(m), corner(m + 1)),
                      leave = edge_between(corner(last), corner(last + 1));
            next[static_cast<std::size_t>(enter)] = leave;
        }
    }
    return next;
}

// Fans each closed loop of the outline from the first corner with no diagonal on a face of the cell: on a face the
// neighbour could have the same diagonal, and an edge would belong to four triangles. Such a corner always exists.
constexpr CellCase triangulated(int inside) {
    CellCase result;
    std::array<int, cell_edges> next = outline(inside);
    for (int first = 0; first < cell_edges; ++first) {
        if (next[static_cast<std::size_t>(first)] < 0) continue;
        std::array<int, cell_edges> loop{};
        int length = 0;
        for (int e = first; next[static_cast<std::size_t>(e)] >= 0;) {
            loop[static_cast<std::size_t>(length++)] = e;
            const int after = next[static_cast<std::size_t>(e)];
            next[static_cast<std::size_t>(e)] = -1;
            e = after;
        }
        const auto at = [&](int n) { return loop[static_cast<std::size_t>(n % length)]; };
        int start = 0;
        const auto has_diagonal_on_a_face = [&] {
            for (int n = 2; n < length - 1; ++n)
                if (lie_on_one_face(at(start), at(start + n))) return true;
            return false;
        };
        while (has_diagonal_on_a_face()) {
            if (++start == length) throw "no fan without a diagonal on a face";  // compile time only
        }
        for (int n = 1; n + 1 < length; ++n) {
            result.triangles[static_cast<std::size_t>(result.count++)] = {static_cast<std::uint8_t>(at(start)),
                                                                          static_cast<std::uint8_t>(at(start + n)),
                                                                          static_cast<std::uint8_t>(at(start + n + 1))};
        }
    }
    return result;
}

consteval std::array<CellCase, cell_case_count> all_cases() {
    std::array<CellCase, cell_case_count> cases;
    for (int inside = 0; inside < cell_case_count; ++inside)
        cases[static_cast<std::size_t>(inside)] = triangulated(inside);
    return cases;
}

}  // namespace detail

/// Triangles by case, anticlockwise seen from outside.
inline constexpr std::array<CellCase, cell_case_count> cell_cases = detail::all_cases();

}  // namespace kerf
