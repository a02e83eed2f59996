// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/revolution_solid.h"

/// A solid at one pose, stamped brick by brick: what `CutField` does for each sub-pose of a record.
namespace kerf {

/// A brick's samples in 18 cells, 4 or 5 × 3 × 3 of them, and the range of values in each: what a stamp leaves out at once.
struct CellRanges {
    static constexpr std::size_t count = 18;
    std::array<std::int16_t, count> lowest, highest;  ///< [quanta]

    void fill(std::int16_t value) noexcept {
        lowest.fill(value);
        highest.fill(value);
    }
};

/// Where a cell's samples are in its brick.
struct CellPlace {
    int first_x, last_x, first_y, first_z;  ///< three rows, three layers

    [[nodiscard]] static constexpr CellPlace of(std::size_t cell) noexcept {
        const int n = static_cast<int>(cell);
        return n % 2 == 0 ? CellPlace{0, 3, n / 2 % 3 * 3, n / 6 * 3} : CellPlace{4, 8, n / 2 % 3 * 3, n / 6 * 3};
    }
};

class PoseStamp {
public:
    /// Outside the cut, this many voxels of distance are all that interpolation and normals ever read.
    static constexpr double band_voxels = 2.0;

    PoseStamp(const Grid& grid, const RevolutionSolid& solid, const Pose& body_from_tool) noexcept
        : grid_(&grid),
          solid_(&solid),
          tool_from_body_(inverse(body_from_tool)),
          step_(rotate(tool_from_body_.rotation, Vec3{grid.spacing, 0, 0})),
          step_y_(rotate(tool_from_body_.rotation, Vec3{0, grid.spacing, 0})),
          step_z_(rotate(tool_from_body_.rotation, Vec3{0, 0, grid.spacing})),
          band_(band_voxels * grid.spacing) {}

    /// Depth of each brick's centre in the solid [m]; `centres` in the body frame.
    void depths_of(const PointBlock& centres, BlockValues& depths) const noexcept {
        solid_->depths(tool_from_body_, centres, depths);
    }
    /// Raises the 9³ samples of brick (i, j, k) [quanta] to the solid's depth, within `first` … `last` (samples of the
    /// grid), and keeps their ranges true. True if any was. Asked row after row of bricks along x, it reuses what they
    /// share.   [haptic, nonblocking]
    bool raise(std::int16_t* samples, CellRanges& ranges, int i, int j, int k, const std::array<int, 3>& first,
               const std::array<int, 3>& last) noexcept;

private:
    void start_rows(int j, int k) noexcept;
    bool raise_cells(std::int16_t* samples, CellRanges& ranges, int i) const noexcept;

    const Grid* grid_;
    const RevolutionSolid* solid_;
    Pose tool_from_body_;
    Vec3 step_, step_y_, step_z_;  ///< from sample to sample along x, y, z, tool frame [m]
    double band_;  ///< [m]
    /// Where each row of samples would begin at x = 0, tool frame, three layers of nine rows each: from global integer
    /// coordinates, so that samples which bricks share get equal bits. Of the bricks (·, at_j_, at_k_).
    PointBlock starts_[3];
    int at_j_ = -1, at_k_ = -1;
};

}  // namespace kerf
