// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/stamp_memory.h"
#include "core/field/grid/grid.h"

/// A solid at one pose, stamped brick by brick: what `CutField` does for each sub-pose of a record.
namespace kerf {

/// A brick's samples in nine cells, 9 × 3 × 3 of them, and what is known of each: what a stamp leaves out at once.
struct BrickCells {
    static constexpr std::size_t count = 9;
    std::array<std::int16_t, count> lowest, highest;  ///< [quanta]
    /// The stamp, by its number, that raises nothing any more, nor would if it were deeper everywhere by `spare`
    /// [quanta]; 0: none.
    std::uint32_t compared;
    std::array<std::int16_t, count> spare;

    void fill(std::int16_t value) noexcept {
        lowest.fill(value);
        highest.fill(value);
        compared = 0;
    }
};

/// Where a cell's samples are in its brick: three layers of three rows.
struct CellPlace {
    int first_y, first_z;

    [[nodiscard]] static constexpr CellPlace of(std::size_t cell) noexcept {
        const int n = static_cast<int>(cell);
        return {n % 3 * 3, n / 3 * 3};
    }
    [[nodiscard]] constexpr int first_sample() const noexcept {
        return (first_z * stored_edge + first_y) * stored_edge;
    }
};

class PoseStamp {
public:
    /// Outside the cut, distances up to two voxels are all that interpolation and normals ever read [m].
    [[nodiscard]] static constexpr double band(double spacing) noexcept { return 2.0 * spacing; }

    /// `memory`: of the field, and outlives it; null: every cell is compared.
    PoseStamp(const Grid& grid, const ToolSolid& solid, const Pose& body_from_tool,
              StampMemory* memory = nullptr) noexcept;

    /// Depth of each brick's centre in the solid [m]; `centres` in the body frame.
    void depths_of(const PointBlock& centres, BlockValues& depths) const noexcept {
        solid_->depths(tool_from_body_, centres, depths);
    }
    /// Whether a sample of brick (i, j, k) may be raised; errs towards true. For a solid of revolution what `depths_of`
    /// says is as good; beside a blade, which is thinner than a brick, half of the bricks that near are not reached.
    [[nodiscard]] bool may_reach(int i, int j, int k) const noexcept;
    /// Raises the 9³ samples of brick (i, j, k) [quanta] to the solid's depth, within `first` … `last` (samples of the
    /// grid), and keeps their cells true. True if any was.   [haptic, nonblocking]
    bool raise(std::int16_t* samples, BrickCells& cells, int i, int j, int k, const std::array<int, 3>& first,
               const std::array<int, 3>& last) noexcept;

    /// Sample (0, 0, 0) of a brick in single precision: its cell's `first` counts on from there.
    [[nodiscard]] SampleCell cell_at(int i, int j, int k) const noexcept;

private:
    /// How the solid has moved since another stamp: by shift + turn × where a point is now, but for `error` of its
    /// distance.
    struct Motion {
        std::uint32_t since = 0;  ///< 0: unknown
        bool is_known = false;    ///< false: it is too long ago, or was another solid
        Vec3 shift{}, turn{};
        double turned = 0.0, error = 0.0;
    };

    /// Whether, by what a brick was compared with before, no sample of it can rise; errs towards no.
    [[nodiscard]] bool is_as_before(const BrickCells& cells, int i, int j, int k) noexcept;
    bool raise_cells(std::int16_t* samples, BrickCells& cells, int i, int j, int k) noexcept;
    /// Null: unknown.
    [[nodiscard]] const Motion* motion_since(std::uint32_t number) noexcept;
    /// A place in a brick, in samples from its first; tool frame [m].
    [[nodiscard]] Vec3 place_in(const SampleCell& brick, double x, double y, double z) const noexcept {
        return origin_ + (static_cast<double>(brick.first[0]) + x) * along_[0] +
               (static_cast<double>(brick.first[1]) + y) * along_[1] +
               (static_cast<double>(brick.first[2]) + z) * along_[2];
    }
    /// Of so many samples to either side, along x and across it: how far that reaches along the tool's axes [m].
    [[nodiscard]] Vec3 extent(double along_x, double across) const noexcept;
    /// [quanta] no sample of a box is deeper by more than it was in an earlier stamp.
    [[nodiscard]] double most_gained(const Motion& motion, Vec3 middle_in_tool, Vec3 half) const noexcept;

    const Grid* grid_;
    const ToolSolid* solid_;
    StampMemory* memory_;
    std::uint32_t number_ = 0;  ///< in the memory, once it has raised a brick
    std::array<Motion, 8> motions_{};
    Pose tool_from_body_;
    double band_;  ///< [m]
    /// Counted from the sample nearest to the tip, so that single precision leaves less than a nanometre about there.
    std::array<int, 3> anchor_;
    Vec3 origin_, along_[3];  ///< of that sample, and from sample to sample along x, y, z; tool frame [m]
    float single_origin_[3], single_along_[3][3];
};

}  // namespace kerf
