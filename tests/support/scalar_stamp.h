// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "core/field/cut_field.h"

namespace kerf::test {

/// What `CutField` stamps, sample by sample and leaving none out: the reference for all that it skips.
struct ScalarStamp {
    const Body& body;
    const RevolutionSolid& solid;
    std::map<std::size_t, std::vector<std::int16_t>> bricks = {};  ///< by index; every brick that holds bone

    void stamp(const CutRecord& record) {
        const Grid& g = body.grid();
        const Sweep sweep(solid, record.from, record.to, 0.25 * g.spacing);
        for (int n = 1; n <= sweep.sub_poses(); ++n) {
            const Pose tool_from_body = inverse(sweep.sub_pose(n));
            const Vec3 step = rotate(tool_from_body.rotation, Vec3{g.spacing, 0, 0});
            for_each_sample([&](int x, int y, int z, std::int16_t& v) {
                const Vec3 row = tool_from_body * g.sample_position(0, y, z);
                const double d = solid.distance(row + static_cast<double>(x) * step);
                if (d <= 2.0 * g.spacing) v = std::max(v, quantised(-d, g.quantum()));
            });
        }
        for_each_sample([&](int x, int y, int z, std::int16_t& v) {
            if (v <= 0 && v > -16384 && sweep.holds(g.sample_position(x, y, z), 0.5 * g.quantum())) v = 1;
        });
    }

private:
    template <class Do>
    void for_each_sample(Do&& what) {
        const Grid& g = body.grid();
        for (int k = 0; k < g.bricks[2]; ++k)
            for (int j = 0; j < g.bricks[1]; ++j)
                for (int i = 0; i < g.bricks[0]; ++i) {
                    const std::size_t index = g.brick_index(i, j, k);
                    if (body.surface.is_all_air(index)) continue;
                    auto& samples = bricks[index];
                    samples.resize(stored_samples, -32767);
                    std::int16_t* v = samples.data();
                    for (int z = k * brick_edge; z <= (k + 1) * brick_edge; ++z)
                        for (int y = j * brick_edge; y <= (j + 1) * brick_edge; ++y)
                            for (int x = i * brick_edge; x <= (i + 1) * brick_edge; ++x, ++v)
                                if (!body.region.is_bounded() || body.region.contains(g.sample_position(x, y, z)))
                                    what(x, y, z, *v);
                }
    }
};

}  // namespace kerf::test
