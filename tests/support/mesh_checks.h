// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/field/surface/mesh.h"

/// What is asked of any mesh.
namespace kerf::test {

/// Edges that are not run along exactly once in each direction.
inline int open_edges(const Mesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t m = 0; m < 3; ++m) runs.emplace_back(triangle[m], triangle[(m + 1) % 3]);
    std::sort(runs.begin(), runs.end());
    int open = 0;
    for (std::size_t n = 0; n < runs.size(); ++n) {
        if (n > 0 && runs[n] == runs[n - 1]) continue;  // counted with the first
        const auto times = [&](std::pair<std::uint32_t, std::uint32_t> edge) {
            const auto [first, last] = std::equal_range(runs.begin(), runs.end(), edge);
            return last - first;
        };
        if (times(runs[n]) != 1 || times({runs[n].second, runs[n].first}) != 1) ++open;
    }
    return open;
}

/// Volume enclosed, positive when the triangles run anticlockwise seen from outside.
inline double volume(const Mesh& mesh) {
    double six_volumes = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        six_volumes += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
    return six_volumes / 6.0;
}

inline int pieces(const Mesh& mesh) {
    std::vector<std::uint32_t> parent(mesh.vertices.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        parent[root(a)] = root(b);
        parent[root(b)] = root(c);
    }
    int count = 0;
    for (std::uint32_t v = 0; v < parent.size(); ++v) count += parent[v] == v;
    return count;
}

/// Numbers in 0 … 1 that are the same everywhere; the standard's distributions differ between libraries.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15U + 1) {}
    double next() {
        state_ ^= state_ << 13;
        state_ ^= state_ >> 7;
        state_ ^= state_ << 17;
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

}  // namespace kerf::test
