// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/field/cut/body_query.h"
#include "tests/support/block.h"

/// A block with a shell, and a drill on its way down, a little oblique and wobbling: committed cut, pending records and
/// all that a query can meet.
namespace kerf::test {

/// The core is heterogeneous.
inline Body shelled_block(Vec3 low, Vec3 high, double shell, double spacing) {
    Body body = block(low, high, spacing, {0.31, 0.17, 0.73});
    const LevelSet border = LevelSet::build(body.grid(), [=](Vec3 p) { return -box_distance(p, low, high) - shell; });
    body.materials = {{"cortical", 1850.0, border}, {"cancellous", 250.0, {}}};
    body.materials[1].densities = DensityField::build(
        body.grid(), [&](std::size_t brick) { return !body.surface.is_all_air(brick); },
        [](Vec3 p) { return 250.0 + 1e4 * p.x - 2e4 * p.z; });
    return body;
}

/// The box from `low` to `high`, its faces moved to samples of the grid that `DrilledBlock` has.
inline Region nearest_samples(double spacing, Vec3 low, Vec3 high) {
    const Grid grid = shelled_block({-6e-3, -6e-3, -14e-3}, {6e-3, 6e-3, 0}, 1e-3, spacing).grid();
    const auto sample = [&](Vec3 p) {
        const Vec3 at = (1.0 / spacing) * (p - grid.origin);
        return grid.sample_position(static_cast<int>(at.x + 0.5), static_cast<int>(at.y + 0.5),
                                    static_cast<int>(at.z + 0.5));
    };
    return {sample(low), sample(high)};
}

struct DrilledBlock {
    double h;
    Body body = shelled_block({-6e-3, -6e-3, -14e-3}, {6e-3, 6e-3, 0}, 1e-3, h);
    ToolSolid tool = drill_outline(1.6e-3, 59.0 * 3.14159265358979 / 180.0, 3e-3);
    CutField committed{body, 1024};
    CutTracker tracker{body, tool, committed};
    BodyQuery view{body, committed, tracker};
    Pose at = pose(-1e-3, 0.0);
    std::uint64_t tick = 0;

    explicit DrilledBlock(double spacing, const Region& region = {}) : h(spacing) {
        body.region = region;
        committed = CutField(body, 1024);
        tracker.restart(at);
        view.place(at);
    }

    static Pose pose(double depth, double wobble) {
        const Vec3 along = normalized(Vec3{0.12 + wobble, -0.07 - 0.5 * wobble, -1.0});
        return pointing(depth * along, along);
    }
    /// Moves the tip to `depth` along its path in `ticks` ticks; the axis turns by `wobble` on the way.
    void move(double depth, double wobble, int ticks, bool is_at_front) {
        const double from = length(at.position) * (at.position.z > 0.0 ? -1.0 : 1.0);
        for (int i = 1; i <= ticks; ++i) {
            at = pose(from + (depth - from) * i / ticks, wobble * i / ticks);
            tracker.advance(at, tick++);
            tracker.commit_passed(at, is_at_front);
        }
        view.place(at);
    }
};

}  // namespace kerf::test
