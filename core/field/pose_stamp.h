// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/tool_solid.h"

/// A solid at one pose, stamped brick by brick: what `CutField` does for each sub-pose of a record.
namespace kerf {

/// A brick's samples in nine cells, 9 × 3 × 3 of them, and the range of values in each: what a stamp leaves out at once.
struct CellRanges {
    static constexpr std::size_t count = 9;
    std::array<std::int16_t, count> lowest, highest;  ///< [quanta]

    void fill(std::int16_t value) noexcept {
        lowest.fill(value);
        highest.fill(value);
    }
};

/// Where a cell's samples are in its brick: three layers of three rows.
struct CellPlace {
    int first_y, first_z;

    [[nodiscard]] static constexpr CellPlace of(std::size_t cell) noexcept {
        const int n = static_cast<int>(cell);
        return {n % 3 * 3, n / 3 * 3};
    }
    [[nodiscard]] constexpr int first_sample() const noexcept { return (first_z * stored_edge + first_y) * stored_edge; }
};

class PoseStamp {
public:
    /// Outside the cut, this many voxels of distance are all that interpolation and normals ever read.
    static constexpr double band_voxels = 2.0;

    PoseStamp(const Grid& grid, const ToolSolid& solid, const Pose& body_from_tool) noexcept;

    /// Depth of each brick's centre in the solid [m]; `centres` in the body frame.
    void depths_of(const PointBlock& centres, BlockValues& depths) const noexcept {
        solid_->depths(tool_from_body_, centres, depths);
    }
    /// Whether a sample of brick (i, j, k) may be raised; errs towards true. For a solid of revolution what `depths_of` says is as
    /// good; beside a blade, which is thinner than a brick, half of the bricks that near are not reached.
    [[nodiscard]] bool may_reach(int i, int j, int k) const noexcept;
    /// Raises the 9³ samples of brick (i, j, k) [quanta] to the solid's depth, within `first` … `last` (samples of the
    /// grid), and keeps their ranges true. True if any was.   [haptic, nonblocking]
    bool raise(std::int16_t* samples, CellRanges& ranges, int i, int j, int k, const std::array<int, 3>& first,
               const std::array<int, 3>& last) const noexcept;

    /// Sample (0, 0, 0) of a brick in single precision: its cell's `first` counts on from there.
    [[nodiscard]] SampleCell cell_at(int i, int j, int k) const noexcept;

private:
    bool raise_cells(std::int16_t* samples, CellRanges& ranges, int i, int j, int k) const noexcept;

    const Grid* grid_;
    const ToolSolid* solid_;
    Pose tool_from_body_;
    double band_;  ///< [m]
    /// Counted from the sample nearest to the tip, so that single precision leaves less than a nanometre about there.
    std::array<int, 3> anchor_;
    Vec3 origin_, along_[3];  ///< of that sample, and from sample to sample along x, y, z; tool frame [m]
    float single_origin_[3], single_along_[3][3];
};

}  // namespace kerf
