// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/stamp_memory.h"
#include "core/field/grid/grid.h"

/// Stamps a solid at one pose, brick by brick: the step of `CutField` for each sub-pose of a record.
namespace kerf {

/// Bounds that let a stamp skip whole cells of a brick. A brick has nine cells of 9 × 3 × 3 samples along x, y, z.
struct BrickCells {
    static constexpr std::size_t count = 9;
    std::array<std::int16_t, count> lowest, highest;  ///< [quanta]
    /// Number of the last stamp that was compared with the brick; 0: none. Repeated, this stamp would raise no sample
    /// of a cell, not even if its solid were deeper everywhere by the cell's `spare` [quanta].
    std::uint32_t compared;
    std::array<std::int16_t, count> spare;

    void fill(std::int16_t value) noexcept {
        lowest.fill(value);
        highest.fill(value);
        compared = 0;
    }
};

/// First row (y) and layer (z) of a cell in its brick. A cell has three rows in each of three layers.
struct CellPosition {
    int first_y, first_z;

    [[nodiscard]] static constexpr CellPosition of(std::size_t cell) noexcept {
        const int n = static_cast<int>(cell);
        return {n % 3 * 3, n / 3 * 3};
    }
    [[nodiscard]] constexpr int first_sample() const noexcept {
        return (first_z * stored_edge + first_y) * stored_edge;
    }
};

class PoseStamp {
public:
    /// Returns how far outside a solid a stamp raises samples [m]: two voxels. Interpolation and normals read no
    /// farther.
    [[nodiscard]] static constexpr double band(double spacing) noexcept { return 2.0 * spacing; }

    /// `memory` belongs to the field and outlives this object; null: every cell is computed.
    PoseStamp(const Grid& grid, const ToolSolid& solid, const Pose& body_from_tool,
              StampMemory* memory = nullptr) noexcept;

    /// Writes the depth of each brick's centre in the solid [m]; `centres` in the body frame.
    void depths_of(const PointBlock& centres, BlockValues& depths) const noexcept {
        solid_->depths(tool_from_body_, centres, depths);
    }
    /// Returns whether a sample of brick (i, j, k) may be raised; errs towards true. Always true for a solid of
    /// revolution, for which `depths_of` excludes as many bricks. A blade is thinner than a brick: of the bricks that
    /// `depths_of` does not exclude, it misses half.
    [[nodiscard]] bool may_reach(int i, int j, int k) const noexcept;
    /// Raises the 9³ samples of brick (i, j, k) [quanta] to the solid's depth where that is larger, and updates
    /// `cells`. Changes only samples `first` … `last` of the grid. Returns whether any sample was raised.
    /// [haptic, nonblocking]
    bool raise(std::int16_t* samples, BrickCells& cells, int i, int j, int k, const std::array<int, 3>& first,
               const std::array<int, 3>& last) noexcept;

    /// Returns the first cell of brick (i, j, k), in single precision.
    [[nodiscard]] SampleCell cell_at(int i, int j, int k) const noexcept;

private:
    /// Motion of a point of the body in the tool frame since an earlier stamp [m]: shift + turn × present position. The
    /// error is at most `error` times the distance of the point from the tool's origin.
    struct Motion {
        std::uint32_t since = 0;  ///< number of the earlier stamp; 0: none
        bool is_known = false;    ///< false: too long ago, another solid, or turned too far
        Vec3 shift{}, turn{};
        double turned = 0.0, error = 0.0;
    };

    /// Returns whether no sample of a brick can rise, according to earlier stamps; errs towards false.
    [[nodiscard]] bool cannot_rise(const BrickCells& cells, int i, int j, int k) noexcept;
    bool raise_cells(std::int16_t* samples, BrickCells& cells, int i, int j, int k) noexcept;
    /// Returns the motion since stamp `number`; null if it is not known.
    [[nodiscard]] const Motion* motion_since(std::uint32_t number) noexcept;
    /// Returns a position in the tool frame [m]. It is given in samples from the first one of `brick`.
    [[nodiscard]] Vec3 position_in(const SampleCell& brick, double x, double y, double z) const noexcept {
        return origin_ + (static_cast<double>(brick.first[0]) + x) * along_[0] +
               (static_cast<double>(brick.first[1]) + y) * along_[1] +
               (static_cast<double>(brick.first[2]) + z) * along_[2];
    }
    /// Returns half of the extent along the tool's axes [m] of a box along the grid's axes. From its middle, the box
    /// extends `along_x` samples to either side along x, and `across` along y and z.
    [[nodiscard]] Vec3 extent(double along_x, double across) const noexcept;
    /// Returns an upper bound of the gain in depth [quanta] of any sample of a box since an earlier stamp. `half`: half
    /// of the box's extent [m].
    [[nodiscard]] double max_depth_gain(const Motion& motion, Vec3 middle_in_tool, Vec3 half) const noexcept;

    const Grid* grid_;
    const ToolSolid* solid_;
    StampMemory* memory_;
    std::uint32_t number_ = 0;  ///< of this stamp in the memory; 0 before its first brick
    std::array<Motion, 8> motions_{};
    Pose tool_from_body_;
    double band_;  ///< [m]
    /// Sample next to the tip. Positions near the tip are relative to it, so that single precision is exact to less
    /// than 1 nm.
    std::array<int, 3> anchor_;
    Vec3 origin_, along_[3];  ///< the anchor, and the steps from sample to sample along x, y, z; tool frame [m]
    float single_origin_[3], single_along_[3][3];
};

}  // namespace kerf
