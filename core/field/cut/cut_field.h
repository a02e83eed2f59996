// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/field/cut/pose_stamp.h"
#include "core/field/cut/sweep.h"
#include "core/field/grid/body.h"
#include "core/field/grid/brick_memory.h"

/// The removed part of a body as a sparse level set: positive where bone has been removed. It begins with the hollow
/// part of the body.
namespace kerf {

class PieceMask;

/// One closed stretch of tool motion. It never changes: all fields stamp the same records, and none divides the motion
/// anew.
struct CutRecord {
    std::uint64_t sequence = 0, tick = 0;
    std::uint16_t body = 0, solid = 0;
    bool removes = true;  ///< false: logged only, and stamped on no field
    Pose from{}, to{};    ///< body_from_tool
};

/// Progress of a record whose stamping is spread over several ticks.
struct StampProgress {
    static constexpr std::size_t to_the_end = ~std::size_t{0};
    int sub_pose = 1;       ///< next to stamp; after the last sub-pose, the ridges follow
    std::size_t brick = 0;  ///< next in the box of bricks around the sub-pose or ridges; `to_the_end`: all done

    [[nodiscard]] bool has_begun() const noexcept { return sub_pose > 1 || brick > 0; }
};

/// Bone is where max(surface, cut) is negative. A stamp sets the cut to max(cut, −distance to the swept solid). This is
/// pure, commutative and idempotent.
class CutField {
public:
    /// Makes a field in which only the body's cavities are removed. Allocates `reserve` free bricks, so that stamping
    /// does not allocate. Throws std::length_error if more than `max_stored_bricks` contain bone.   [main]
    CutField(const Body& body, std::size_t reserve);

    /// Makes the cut of a piece that separated from a body with the cut `whole`. It also removes the samples that
    /// `mask` marks as not of the piece. `reserve` as above.   [worker]
    CutField(const CutField& whole, const PieceMask& mask, std::size_t reserve);

    /// Copies the cut and its capacity for growth.   [main, worker]
    CutField(const CutField& other);
    CutField(CutField&&) noexcept = default;
    CutField& operator=(const CutField& other) { return *this = CutField(other); }
    CutField& operator=(CutField&&) noexcept = default;
    ~CutField() = default;

    /// Stamps one record on samples strictly within the body's region. Returns the number of touched bricks. A brick
    /// counts once for each sub-pose that reaches it, whether or not a sample changes, and a quarter for the ridges.
    ///
    /// It stamps sub-poses that depend on record, solid and spacing alone. They are at most a quarter voxel apart,
    /// except on a slide that the solid covers. Then it clears samples on the ridges between sub-poses, so that no
    /// sample inside the exact sweep stays bone. The depth of these samples is too small by at most the height of a
    /// ridge, an eighth of a voxel.   [haptic, nonblocking] while `free_bricks()` suffices; else it allocates.
    int stamp(const CutRecord& record, const ToolSolid& solid);
    /// Stamps a part of a record. Continues at `progress`, adding to `touched`, until `touched` reaches `maximum` or
    /// the record is done. Returns whether the record is done; the field then has the same bits as after `stamp`.
    /// [haptic, nonblocking] as above.
    bool stamp_part(const CutRecord& record, const ToolSolid& solid, int maximum, StampProgress& progress,
                    int& touched);

    /// Allocates until at least `count` bricks are free, or until each brick with bone has one.   [main, worker]
    void reserve(std::size_t count);
    [[nodiscard]] std::size_t free_bricks() const noexcept { return capacity_ - used_; }

    /// Returns the trilinear cut [m]: positive where removed, −clamp where never cut.   [any] pure, nonblocking.
    [[nodiscard]] double at(const LocatedPoint& place) const noexcept {
        const std::int32_t start = place.is_inside ? start_[place.brick] : uncut;
        if (start < first_stored) return start == uncut ? -clamp_ : clamp_;
        return quantum_ * static_cast<double>(trilinear(brick(start), place));
    }
    /// Returns the trilinear cut [quanta], with the sign of `at`.
    [[nodiscard]] float quanta_at(const LocatedPoint& place) const noexcept {
        const std::int32_t start = place.is_inside ? start_[place.brick] : uncut;
        return start < first_stored ? static_cast<float>(*brick(start)) : trilinear(brick(start), place);
    }
    /// Writes the trilinear cut [quanta] of a block of points.   [any] pure, nonblocking.
    void quanta_at(const LocatedBlock& places, FloatBlock& quanta) const noexcept {
        block_kernel().values(shape(), places.count, places.places(), quanta.data());
    }
    [[nodiscard]] FieldShape shape() const noexcept { return {start_.data(), samples_.data(), first_stored, uncut}; }
    [[nodiscard]] std::int16_t sample(int i, int j, int k) const noexcept;
    [[nodiscard]] const std::int16_t* stored(std::size_t brick_index) const noexcept {
        return start_[brick_index] == uncut ? nullptr : brick(start_[brick_index]);
    }
    /// Returns whether the whole brick lies in other pieces, by the mask of the constructor. Such a brick never
    /// changes.
    [[nodiscard]] bool is_removed(std::size_t brick_index) const noexcept { return start_[brick_index] == all_removed; }
    /// First and last sample along each axis that may be cut: those strictly within the body's region.
    [[nodiscard]] const std::array<int, 3>& first_sample() const noexcept { return first_; }
    [[nodiscard]] const std::array<int, 3>& last_sample() const noexcept { return last_; }
    /// Returns the indices of the bricks that stamping changed since the last call, ascending.   [worker]
    std::vector<std::size_t> take_changed();

    /// Returns the 64-bit FNV-1a hash of all stored samples above −32767 (uncut), each with its brick and its index.
    [[nodiscard]] std::uint64_t hash() const noexcept;
    /// Returns the indices of the bricks whose values differ from those of another cut of the same body, ascending.
    /// [worker]
    [[nodiscard]] std::vector<std::size_t> differing_bricks(const CutField& other) const;
    /// Returns whether both cuts have the same values, bit for bit (storage may differ).
    [[nodiscard]] bool same_bits(const CutField& other) const noexcept;
    [[nodiscard]] const Grid& grid() const noexcept { return body_->grid(); }

private:
    // All uncut bricks use one common brick of samples, and all removed bricks another: interpolation needs no special
    // case.
    static constexpr std::int32_t uncut = 0, all_removed = stored_samples, first_stored = 2 * stored_samples;
    [[nodiscard]] std::int16_t* brick(std::int32_t start) noexcept { return samples_.data() + start; }
    [[nodiscard]] const std::int16_t* brick(std::int32_t start) const noexcept { return samples_.data() + start; }
    [[nodiscard]] BrickCells& cells_of(std::size_t brick_index) noexcept {
        return cells_[static_cast<std::size_t>((start_[brick_index] - first_stored) / stored_samples)];
    }
    struct BrickBox {
        std::array<int, 3> first, last;

        [[nodiscard]] std::size_t count() const noexcept { return layer() * extent(2); }
        [[nodiscard]] std::array<int, 3> operator[](std::size_t n) const noexcept {
            return {first[0] + static_cast<int>(n % extent(0)), first[1] + static_cast<int>(n / extent(0) % extent(1)),
                    first[2] + static_cast<int>(n / layer())};
        }
        /// Advances to the next brick. Faster than operator[], whose divisions would dominate the loop over hundreds of
        /// bricks.
        void next_brick(std::array<int, 3>& place) const noexcept {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (++place[axis] <= last[axis]) return;
                place[axis] = first[axis];
            }
        }

    private:
        [[nodiscard]] std::size_t extent(std::size_t axis) const noexcept {
            return static_cast<std::size_t>(std::max(0, last[axis] - first[axis] + 1));
        }
        [[nodiscard]] std::size_t layer() const noexcept { return extent(0) * extent(1); }
    };
    /// Returns a box of all bricks whose samples may lie within `band` [m] of the solid.
    [[nodiscard]] BrickBox bricks_near(const ToolSolid& solid, const Pose& body_from_tool, double band) const noexcept;
    /// Stamps one sub-pose, from number `next` of its `bricks_near` on, until `touched` reaches `maximum`. Returns the
    /// number at which to continue, or `to_the_end`.
    std::size_t stamp_pose(const Pose& body_from_tool, const ToolSolid& solid, std::size_t next, int maximum,
                           int& touched);
    /// Stamps the solid on a block of bricks, given by their centres (body frame) and coordinates. Returns how many
    /// bricks are done.
    std::size_t stamp_bricks(PoseStamp& stamp, const PointBlock& centres, const std::array<int, 3>* places, int maximum,
                             int& touched);
    /// Makes samples inside the sweep, but inside none of its sub-poses, one quantum deep. `next` and the result are as
    /// in `stamp_pose`, in the box of bricks around both ends. Four bricks count as one touched brick.
    std::size_t clear_ridges(const Sweep& sweep, const ToolSolid& solid, const CutRecord& record, std::size_t next,
                             int maximum, int& touched) noexcept;

    [[nodiscard]] bool same_in(std::size_t brick_index, const CutField& other) const noexcept;
    /// Reserves memory for every brick that can be cut, and finds the samples that may be cut.
    void prepare();
    /// Computes the range of values of each cell of a brick, and whether the brick is full.
    void find_ranges(std::size_t brick_index) noexcept;
    /// Gives an uncut brick samples of its own, all −32767, and returns them.
    std::int16_t* open_brick(std::size_t brick_index);
    /// Marks the hollow part as removed from the start.
    void mark_hollow(const LevelSet& hollow);

    const Body* body_;
    double clamp_ = 0.0, quantum_ = 0.0;
    std::array<int, 3> first_ = {}, last_ = {};  ///< samples that may be cut: those strictly within the body's region
    std::vector<std::int32_t> start_;            ///< first sample of each brick; the last entry: outside the grid
    std::vector<std::uint8_t> changed_;
    std::vector<std::uint8_t> is_full_;   ///< true if every sample has the highest value: nothing left to stamp
    BrickSamples<std::int16_t> samples_;  ///< reserved for every brick that can be cut, so that stamping never moves it
    std::vector<BrickCells> cells_;       ///< of each allocated brick
    StampMemory memory_;
    std::size_t used_ = 0, capacity_ = 0, max_bricks_ = 0;  ///< bricks stored, allocated, with bone
};

}  // namespace kerf
