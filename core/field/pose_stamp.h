// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/revolution_solid.h"

/// A solid at one pose, stamped brick by brick: what `CutField` does for each sub-pose of a record.
namespace kerf {

class PoseStamp {
public:
    /// Outside the cut, this many voxels of distance are all that interpolation and normals ever read.
    static constexpr double band_voxels = 2.0;

    PoseStamp(const Grid& grid, const RevolutionSolid& solid, const Pose& body_from_tool) noexcept
        : grid_(&grid),
          solid_(&solid),
          tool_from_body_(inverse(body_from_tool)),
          step_(rotate(tool_from_body_.rotation, Vec3{grid.spacing, 0, 0})),
          band_(band_voxels * grid.spacing) {}

    /// Depth of each brick's centre in the solid [m]; `centres` in the body frame.
    void depths_of(const PointBlock& centres, BlockValues& depths) const noexcept {
        solid_->depths(tool_from_body_, centres, depths);
    }
    /// Raises the 9³ samples of brick (i, j, k) [quanta] to the solid's depth, within `first` … `last` (samples of the
    /// grid). True if any was. Asked row after row of bricks along x, it reuses what they share.   [haptic, nonblocking]
    bool raise(std::int16_t* samples, int i, int j, int k, const std::array<int, 3>& first,
               const std::array<int, 3>& last) noexcept;

private:
    static constexpr std::size_t rows_per_brick = static_cast<std::size_t>(stored_edge * stored_edge);
    static constexpr std::size_t first_half = 5 * stored_edge;  ///< 81 rows are more than a block holds

    struct Row {
        std::uint8_t row;
        std::int32_t deepest;  ///< no less than the depth in its middle [quanta]
    };

    void start_rows(int j, int k) noexcept;
    /// Those rows, of the brick's 81, in which a sample may rise; returns how many.
    std::size_t rows_that_matter(const std::int16_t* samples, int i, const std::array<int, 3>& first,
                                 const std::array<int, 3>& last,
                                 std::array<Row, rows_per_brick>& rows) const noexcept;
    [[nodiscard]] Vec3 start_of(std::size_t row) const noexcept {
        return row < first_half ? starts_[0][row] : starts_[1][row - first_half];
    }

    const Grid* grid_;
    const RevolutionSolid* solid_;
    Pose tool_from_body_;
    Vec3 step_;    ///< from sample to sample along x, tool frame [m]
    double band_;  ///< [m]
    /// Where each row of samples would begin at x = 0, tool frame: from global integer coordinates, so that samples
    /// which bricks share get equal bits. Of the bricks (·, at_j_, at_k_).
    PointBlock starts_[2];
    int at_j_ = -1, at_k_ = -1;
};

}  // namespace kerf
