// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "core/field/cut/cut_field.h"

namespace kerf::test {

/// What `CutField` stamps, every sample of every brick by the portable kernel: the reference for all that it skips.
struct ScalarStamp {
    const Body& body;
    const ToolSolid& solid;
    std::map<std::size_t, std::vector<std::int16_t>> bricks = {};  ///< by index; every brick that holds bone

    void stamp(const CutRecord& record) {
        const Grid& g = body.grid();
        const Sweep sweep(solid, record.from, record.to, 0.25 * g.spacing, PoseStamp::band(g.spacing));
        for (int n = 1; n <= sweep.sub_poses(); ++n) {
            const PoseStamp pose(g, solid, sweep.sub_pose(n));
            for_each_brick([&](int i, int j, int k, std::int16_t* samples) {
                std::array<std::int16_t, stored_samples> raised;
                std::copy_n(samples, stored_samples, raised.data());
                for (std::size_t c = 0; c < BrickCells::count; ++c) {
                    const CellPosition at = CellPosition::of(c);
                    SampleCell cell = pose.cell_at(i, j, k);
                    cell.first[1] += static_cast<float>(at.first_y);
                    cell.first[2] += static_cast<float>(at.first_z);
                    std::int16_t lowest, highest;
                    portable_kernel().raise(solid.single(), cell, static_cast<float>(PoseStamp::band(g.spacing)),
                                            static_cast<float>(1.0 / g.quantum()), raised.data() + at.first_sample(),
                                            lowest, highest, nullptr);
                }
                const std::int16_t* to = raised.data();
                for_each_sample(i, j, k, samples, [&](int, int, int, std::int16_t& v) { v = to[&v - samples]; });
            });
        }
        for_each_brick([&](int i, int j, int k, std::int16_t* samples) {
            for_each_sample(i, j, k, samples, [&](int x, int y, int z, std::int16_t& v) {
                if (v <= 0 && v > -16384 && sweep.contains(g.sample_position(x, y, z), 0.5 * g.quantum())) v = 1;
            });
        });
    }

private:
    template <class Do>
    void for_each_brick(Do&& what) {
        const Grid& g = body.grid();
        for (int k = 0; k < g.bricks[2]; ++k)
            for (int j = 0; j < g.bricks[1]; ++j)
                for (int i = 0; i < g.bricks[0]; ++i) {
                    const std::size_t index = g.brick_index(i, j, k);
                    if (body.surface.is_all_air(index)) continue;
                    auto& samples = bricks[index];
                    samples.resize(stored_samples, -32767);
                    what(i, j, k, samples.data());
                }
    }
    /// Those that may be cut.
    template <class Do>
    void for_each_sample(int i, int j, int k, std::int16_t* v, Do&& what) const {
        const Grid& g = body.grid();
        for (int z = k * brick_edge; z <= (k + 1) * brick_edge; ++z)
            for (int y = j * brick_edge; y <= (j + 1) * brick_edge; ++y)
                for (int x = i * brick_edge; x <= (i + 1) * brick_edge; ++x, ++v)
                    if (!body.region.is_bounded() || body.region.contains(g.sample_position(x, y, z)))
                        what(x, y, z, *v);
    }
};

}  // namespace kerf::test
