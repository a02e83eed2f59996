// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/field/cut/cut_field.h"

/// Pieces of bone found the plain ways, by looking at the whole volume. What the fast way is held against.
namespace kerf::test {

struct SolidVolume {
    std::array<int, 3> size{};
    std::vector<std::uint8_t> solid;

    [[nodiscard]] std::size_t at(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(size[0]) +
               static_cast<std::size_t>(i);
    }
};

inline SolidVolume solid_volume(const Body& body, const CutField& cut) {
    const Grid& g = body.grid();
    SolidVolume v{{g.samples(0), g.samples(1), g.samples(2)}, {}};
    v.solid.resize(v.at(0, 0, v.size[2]));
    for (int k = 0; k < v.size[2]; ++k)
        for (int j = 0; j < v.size[1]; ++j)
            for (int i = 0; i < v.size[0]; ++i)
                v.solid[v.at(i, j, k)] = body.surface.sample(i, j, k) < 0 && cut.sample(i, j, k) < 0 &&
                                         body.region.contains(g.sample_position(i, j, k));
    return v;
}

/// Labels from 1 on in the order of the first sample, 0 for air: a flood of voxels from each that has no label yet.
inline std::vector<std::uint32_t> flooded(const SolidVolume& v, std::vector<std::size_t>* sizes = nullptr) {
    std::vector<std::uint32_t> label(v.solid.size(), 0);
    std::vector<std::size_t> queue;
    std::uint32_t last = 0;
    const auto nx = static_cast<std::size_t>(v.size[0]), layer = nx * static_cast<std::size_t>(v.size[1]);
    for (std::size_t seed = 0; seed < v.solid.size(); ++seed) {
        if (v.solid[seed] == 0 || label[seed] != 0) continue;
        label[seed] = ++last;
        queue.assign(1, seed);
        for (std::size_t n = 0; n < queue.size(); ++n) {
            const std::size_t s = queue[n];
            const int i = static_cast<int>(s % nx), j = static_cast<int>(s % layer / nx),
                      k = static_cast<int>(s / layer);
            const auto go = [&](bool is_there, std::size_t to) {
                if (!is_there || v.solid[to] == 0 || label[to] != 0) return;
                label[to] = last;
                queue.push_back(to);
            };
            go(i > 0, s - 1);
            go(i + 1 < v.size[0], s + 1);
            go(j > 0, s - nx);
            go(j + 1 < v.size[1], s + nx);
            go(k > 0, s - layer);
            go(k + 1 < v.size[2], s + layer);
        }
        if (sizes != nullptr) sizes->push_back(queue.size());
    }
    return label;
}

/// The same by runs along x that are joined where they touch: how many pieces, and the samples of each, largest first.
inline std::vector<std::size_t> pieces_by_runs(const SolidVolume& v) {
    struct Run {
        int from, to;
        std::uint32_t parent;
        std::size_t samples;
    };
    std::vector<Run> runs;
    const auto rows = static_cast<std::size_t>(v.size[1]) * static_cast<std::size_t>(v.size[2]);
    std::vector<std::size_t> first(rows + 1);
    const auto root = [&](std::uint32_t n) {
        while (runs[n].parent != n) n = runs[n].parent = runs[runs[n].parent].parent;
        return n;
    };
    const auto join_rows = [&](std::size_t a, std::size_t a_end, std::size_t b, std::size_t b_end) {
        while (a < a_end && b < b_end) {
            if (runs[a].from < runs[b].to && runs[b].from < runs[a].to) {
                const std::uint32_t p = root(static_cast<std::uint32_t>(a)), q = root(static_cast<std::uint32_t>(b));
                runs[std::max(p, q)].parent = std::min(p, q);
            }
            ++(runs[a].to < runs[b].to ? a : b);
        }
    };
    const auto ny = static_cast<std::size_t>(v.size[1]);
    for (std::size_t row = 0; row < rows; ++row) {
        first[row] = runs.size();
        const std::uint8_t* s = v.solid.data() + row * static_cast<std::size_t>(v.size[0]);
        for (int i = 0; i < v.size[0]; ++i) {
            if (s[i] == 0) continue;
            const int from = i;
            while (i < v.size[0] && s[i] != 0) ++i;
            runs.push_back({from, i, static_cast<std::uint32_t>(runs.size()), static_cast<std::size_t>(i - from)});
        }
        first[row + 1] = runs.size();
        if (row % ny != 0) join_rows(first[row - 1], first[row], first[row], runs.size());
        if (row >= ny) join_rows(first[row - ny], first[row - ny + 1], first[row], runs.size());
    }
    std::vector<std::size_t> sizes(runs.size(), 0), pieces;
    for (std::size_t n = 0; n < runs.size(); ++n) sizes[root(static_cast<std::uint32_t>(n))] += runs[n].samples;
    for (const std::size_t s : sizes)
        if (s > 0) pieces.push_back(s);
    std::sort(pieces.rbegin(), pieces.rend());
    return pieces;
}

}  // namespace kerf::test
