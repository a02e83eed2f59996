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

/// What has been removed from a body, as a sparse level set: positive where bone is gone. It begins with what is
/// hollow.
namespace kerf {

class PieceMask;

/// One closed stretch of tool motion. Append-only: everybody stamps records, nobody re-segments poses (R2).
struct CutRecord {
    std::uint64_t sequence = 0, tick = 0;
    std::uint16_t body = 0, solid = 0;
    bool removes = true;  ///< false: logged only, nobody stamps it
    Pose from{}, to{};    ///< body_from_tool
};

/// How far a record has been stamped, where that is spread over several ticks.
struct StampProgress {
    static constexpr std::size_t to_the_end = ~std::size_t{0};
    int sub_pose = 1;       ///< beyond the last: the ridges
    std::size_t brick = 0;  ///< of those near it; `to_the_end`: done

    [[nodiscard]] bool has_begun() const noexcept { return sub_pose > 1 || brick > 0; }
};

/// Bone is max(surface, cut). Stamping is max(cut, −distance to the swept solid): pure, commutative, idempotent.
class CutField {
public:
    /// `reserve` bricks are ready before the first stamp, so that stamping does not allocate.   [main]
    CutField(const Body& body, std::size_t reserve);

    /// The cut of a piece that came away from what `whole` cut: gone too is what the mask says. `reserve` as above.
    /// [worker]
    CutField(const CutField& whole, const PieceMask& mask, std::size_t reserve);

    /// With as much room to grow as the first.   [main, worker]
    CutField(const CutField& other);
    CutField(CutField&&) noexcept = default;
    CutField& operator=(const CutField& other) { return *this = CutField(other); }
    CutField& operator=(CutField&&) noexcept = default;
    ~CutField() = default;

    /// Stamps one record, within the body's region: sub-poses at most a quarter voxel apart, a function of (record,
    /// spacing) alone; then what lies on the ridges between them, so that no sample within the exact sweep stays bone.
    /// Its depth is understated by a ridge's height at most, an eighth of a voxel. Returns the bricks touched.
    /// [haptic, nonblocking] while `free_bricks()` suffices, else it allocates.
    int stamp(const CutRecord& record, const ToolSolid& solid);
    /// The same in pieces, with the same bits in the end: goes on from `progress` until about `most` bricks are touched
    /// or the record is done; true then. `touched` counts them.   [haptic, nonblocking] as above.
    bool stamp_on(const CutRecord& record, const ToolSolid& solid, int most, StampProgress& progress, int& touched);

    /// Makes room for `count` further bricks, or for as many as hold bone.   [main, worker]
    void reserve(std::size_t count);
    [[nodiscard]] std::size_t free_bricks() const noexcept { return capacity_ - used_; }

    /// Trilinear cut [m]: positive where removed; −clamp where never cut.   [any] pure, nonblocking.
    [[nodiscard]] double at(const BrickPlace& place) const noexcept {
        const std::int32_t start = place.is_inside ? start_[place.brick] : uncut;
        if (start < first_stored) return start == uncut ? -clamp_ : clamp_;
        return quantum_ * static_cast<double>(trilinear(brick(start), place));
    }
    /// The same [quanta].
    [[nodiscard]] float quanta_at(const BrickPlace& place) const noexcept {
        const std::int32_t start = place.is_inside ? start_[place.brick] : uncut;
        return start < first_stored ? static_cast<float>(*brick(start)) : trilinear(brick(start), place);
    }
    /// The same for a block.   [any] pure, nonblocking.
    void quanta_at(const PlaceBlock& places, FloatBlock& quanta) const noexcept {
        block_kernel().values(shape(), places.count, places.places(), quanta.data());
    }
    [[nodiscard]] FieldShape shape() const noexcept { return {start_.data(), samples_.data(), first_stored, uncut}; }
    [[nodiscard]] std::int16_t sample(int i, int j, int k) const noexcept;
    [[nodiscard]] const std::int16_t* stored(std::size_t brick_index) const noexcept {
        return start_[brick_index] == uncut ? nullptr : brick(start_[brick_index]);
    }
    /// Whether all of a brick is another piece's: nothing in it can ever change.
    [[nodiscard]] bool is_gone(std::size_t brick_index) const noexcept { return start_[brick_index] == gone; }
    /// The samples that may be cut, along each axis: those strictly within the body's region.
    [[nodiscard]] const std::array<int, 3>& first_sample() const noexcept { return first_; }
    [[nodiscard]] const std::array<int, 3>& last_sample() const noexcept { return last_; }
    /// Bricks whose values changed since the last call, ascending.   [worker]
    std::vector<std::size_t> take_changed();

    /// 64-bit FNV-1a over every sample that is not the default, with its index.
    [[nodiscard]] std::uint64_t hash() const noexcept;
    /// Bricks whose values are not the same in another cut of the same body, ascending.   [worker]
    [[nodiscard]] std::vector<std::size_t> differing_bricks(const CutField& other) const;
    /// Whether both hold the same bits (storage may differ).
    [[nodiscard]] bool same_bits(const CutField& other) const noexcept;
    [[nodiscard]] const Grid& grid() const noexcept { return body_->grid(); }

private:
    // Bricks that were never cut have samples too, one brick for all, and so have those that are another piece's: who
    // interpolates need not tell them apart.
    static constexpr std::int32_t uncut = 0, gone = stored_samples, first_stored = 2 * stored_samples;
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
        /// From a brick to the one after it: hundreds in a row, and the divisions above would take longer than looking
        /// at most.
        void go_on(std::array<int, 3>& place) const noexcept {
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
    /// Bricks whose samples may lie within `band` [m] of the solid.
    [[nodiscard]] BrickBox bricks_near(const ToolSolid& solid, const Pose& body_from_tool, double band) const noexcept;
    /// From the brick `next` on; where it stopped, or `to_the_end`.
    std::size_t stamp_pose(const Pose& body_from_tool, const ToolSolid& solid, std::size_t next, int most,
                           int& touched);
    /// Of the bricks with these centres and places, those that the solid reaches. How many were looked at.
    std::size_t stamp_bricks(PoseStamp& stamp, const PointBlock& centres, const std::array<int, 3>* places, int most,
                             int& touched);
    /// Samples that the sweep holds and none of its sub-poses does become one quantum deep. Bricks as in `stamp_pose`;
    /// four of them count as one.
    std::size_t clear_ridges(const Sweep& sweep, const ToolSolid& solid, const CutRecord& record, std::size_t next,
                             int most, int& touched) noexcept;

    [[nodiscard]] bool same_in(std::size_t brick_index, const CutField& other) const noexcept;
    /// Room for every brick that can be cut, and what may be cut.
    void prepare();
    /// Of samples that were put in at once.
    void find_ranges(std::size_t brick_index) noexcept;
    /// A brick in which nothing is cut yet.
    std::int16_t* open_brick(std::size_t brick_index);
    /// What is hollow was never bone.
    void begin_with(const LevelSet& hollow);

    const Body* body_;
    double clamp_ = 0.0, quantum_ = 0.0;
    std::array<int, 3> first_ = {}, last_ = {};  ///< samples that may be cut: those within the body's region
    std::vector<std::int32_t> start_;  ///< of each brick among the samples; the last entry is outside the grid
    std::vector<std::uint8_t> changed_;
    std::vector<std::uint8_t> is_full_;   ///< every sample as high as it can be: nothing left to stamp
    BrickSamples<std::int16_t> samples_;  ///< has room for every brick that can be cut, so stamping never moves it
    std::vector<BrickCells> cells_;       ///< of the bricks in use
    StampMemory memory_;
    std::size_t used_ = 0, capacity_ = 0, most_ = 0;  ///< bricks; `most_` is how many hold bone
};

}  // namespace kerf
