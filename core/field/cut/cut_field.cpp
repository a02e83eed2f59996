// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/cut_field.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "core/field/cut/piece_mask.h"
#include "core/field/fnv1a.h"

namespace kerf {

namespace {

/// A block of samples that may lie on a ridge between sub-poses.
class RidgeBlock {
public:
    RidgeBlock(const Sweep& sweep, double tolerance) noexcept : sweep_(&sweep), tolerance_(tolerance) {}

    void add(Vec3 point_in_body, std::size_t brick, std::uint16_t sample) noexcept {
        bricks_[points_.count] = brick;
        samples_[points_.count] = sample;
        points_.add(point_in_body);
    }
    [[nodiscard]] bool is_full() const noexcept { return points_.count == block_capacity; }

    /// Calls `what(brick, sample)` for each sample that the sweep contains, and empties the block.
    template <class Do>
    void for_each_contained(const Do& what) noexcept {
        std::array<bool, block_capacity> may_contain;
        sweep_->may_contain(points_, tolerance_, may_contain);
        for (std::size_t n = 0; n < points_.count; ++n)
            if (may_contain[n] && sweep_->contains(points_[n], tolerance_)) what(bricks_[n], samples_[n]);
        points_.count = 0;
    }

private:
    const Sweep* sweep_;
    double tolerance_;
    PointBlock points_;
    std::array<std::size_t, block_capacity> bricks_;
    std::array<std::uint16_t, block_capacity> samples_;
};

}  // namespace

CutField::CutField(const Body& body, std::size_t reserve_bricks)
    : body_(&body),
      clamp_(body.grid().clamp()),
      quantum_(body.grid().quantum()),
      start_(body.grid().brick_count() + 1, uncut),
      changed_(body.grid().brick_count(), 0),
      is_full_(body.grid().brick_count(), 0) {
    prepare();
    if (!body.hollow.is_empty()) mark_hollow(body.hollow);
    reserve(reserve_bricks);
}

void CutField::prepare() {
    const Grid& g = grid();
    for (std::size_t b = 0; b < g.brick_count(); ++b) max_bricks_ += !body_->surface.is_all_air(b);
    if (max_bricks_ > max_stored_bricks) throw std::length_error("more bricks of bone than can be cut");
    samples_.reserve((max_bricks_ + 2) * stored_samples);
    cells_.reserve(max_bricks_);
    samples_.assign(first_stored, -32767);
    std::fill(samples_.begin() + all_removed, samples_.end(), std::int16_t{32767});
    for (std::size_t axis = 0; axis < 3; ++axis) last_[axis] = g.samples(axis);
    const Region& region = body_->region;
    if (!region.is_bounded()) return;
    const std::array<double, 3> low{region.low.x, region.low.y, region.low.z};
    const std::array<double, 3> high{region.high.x, region.high.y, region.high.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = [&](int i) {
            const Vec3 p = g.sample_position(i, i, i);
            return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
        };
        while (first_[axis] <= last_[axis] && !(at(first_[axis]) > low[axis])) ++first_[axis];
        while (last_[axis] >= first_[axis] && !(at(last_[axis]) < high[axis])) --last_[axis];
    }
}

CutField::CutField(const CutField& other)
    : body_(other.body_),
      clamp_(other.clamp_),
      quantum_(other.quantum_),
      start_(other.start_),
      changed_(other.changed_),
      is_full_(other.is_full_) {
    prepare();
    samples_.assign(other.samples_.begin(), other.samples_.end());
    cells_.assign(other.cells_.begin(), other.cells_.end());
    memory_ = other.memory_;
    used_ = other.used_;
    capacity_ = other.capacity_;
}

CutField::CutField(const CutField& whole, const PieceMask& mask, std::size_t reserve_bricks)
    : body_(whole.body_),
      clamp_(whole.clamp_),
      quantum_(whole.quantum_),
      start_(whole.start_.size(), uncut),
      changed_(whole.changed_.size(), 0),
      is_full_(whole.is_full_.size(), 0) {
    prepare();
    const Grid& g = grid();
    for (std::size_t index = 0; index < g.brick_count(); ++index) {
        if (body_->surface.is_all_air(index)) continue;
        const auto [i, j, k] = g.brick_coordinates(index);

        // The stored samples of a brick include the first ones of its upper neighbours: these must agree too.
        const PieceMask::RemovedExtent extent = mask.removed_extent(index);
        bool is_alike = extent != PieceMask::RemovedExtent::some;
        for (int c = 1; is_alike && c < 8; ++c) {
            const int bi = i + (c & 1), bj = j + (c >> 1 & 1), bk = k + (c >> 2);
            if (bi < g.bricks[0] && bj < g.bricks[1] && bk < g.bricks[2])
                is_alike = mask.removed_extent(g.brick_index(bi, bj, bk)) == extent;
        }
        if (is_alike && (extent == PieceMask::RemovedExtent::everything || whole.start_[index] == all_removed)) {
            start_[index] = all_removed;
            is_full_[index] = 1;
            continue;
        }
        if (is_alike && whole.start_[index] == uncut) continue;

        std::int16_t* samples = open_brick(index);
        const std::int16_t* before = whole.brick(whole.start_[index]);
        for (int z = 0, s = 0; z < stored_edge; ++z)
            for (int y = 0; y < stored_edge; ++y)
                for (int x = 0; x < stored_edge; ++x, ++s)
                    samples[s] =
                        !is_alike && mask.is_removed(i * brick_edge + x, j * brick_edge + y, k * brick_edge + z)
                            ? std::int16_t{32767}
                            : before[s];
        find_ranges(index);
    }
    reserve(reserve_bricks);
}

std::int16_t* CutField::open_brick(std::size_t index) {
    if (free_bricks() == 0) reserve(1);
    start_[index] = first_stored + static_cast<std::int32_t>(used_++) * stored_samples;
    cells_of(index).fill(-32767);
    return brick(start_[index]);
}

void CutField::mark_hollow(const LevelSet& hollow) {
    for (std::size_t index = 0; index < body_->grid().brick_count(); ++index) {
        if (hollow.is_all_air(index) || body_->surface.is_all_air(index)) continue;
        std::int16_t* samples = open_brick(index);
        const std::int16_t* cavity = hollow.stored(index);
        for (std::size_t s = 0; s < stored_samples; ++s)
            samples[s] = static_cast<std::int16_t>(cavity ? -cavity[s] : 32767);
        find_ranges(index);
    }
}

void CutField::find_ranges(std::size_t index) noexcept {
    const std::int16_t* samples = brick(start_[index]);
    BrickCells& cells = cells_of(index);
    for (std::size_t cell = 0; cell < BrickCells::count; ++cell) {
        const std::int16_t* first = samples + CellPosition::of(cell).first_sample();
        std::int16_t lowest = 32767, highest = -32767;
        for (int z = 0; z < 3; ++z)
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < stored_edge; ++x) {
                    const std::int16_t value = first[(z * stored_edge + y) * stored_edge + x];
                    lowest = std::min(lowest, value);
                    highest = std::max(highest, value);
                }
        cells.lowest[cell] = lowest;
        cells.highest[cell] = highest;
    }
    cells.compared = 0;
    is_full_[index] = std::all_of(cells.lowest.begin(), cells.lowest.end(), [](std::int16_t s) { return s == 32767; });
}

void CutField::reserve(std::size_t count) {
    const std::size_t wanted = std::min(used_ + count, max_bricks_);
    if (wanted <= capacity_) return;
    constexpr std::size_t some = 256;  // allocated at a time
    capacity_ = std::min((wanted + some - 1) / some * some, max_bricks_);
    samples_.resize((capacity_ + 2) * stored_samples, -32767);
    cells_.resize(capacity_);
}

int CutField::stamp(const CutRecord& record, const ToolSolid& solid) {
    StampProgress progress;
    int touched = 0;
    stamp_part(record, solid, std::numeric_limits<int>::max(), progress, touched);
    return touched;
}

bool CutField::stamp_part(const CutRecord& record, const ToolSolid& solid, int maximum, StampProgress& progress,
                          int& touched) {
    const Sweep sweep(solid, record.from, record.to, 0.25 * grid().spacing, PoseStamp::band(grid().spacing));
    for (; progress.sub_pose <= sweep.sub_poses(); ++progress.sub_pose) {
        progress.brick = stamp_pose(sweep.sub_pose(progress.sub_pose), solid, progress.brick, maximum, touched);
        if (progress.brick != StampProgress::to_the_end) return false;
        progress.brick = 0;
    }
    progress.brick = clear_ridges(sweep, solid, record, progress.brick, maximum, touched);
    return progress.brick == StampProgress::to_the_end;
}

CutField::BrickBox CutField::bricks_near(const ToolSolid& solid, const Pose& body_from_tool,
                                         double band) const noexcept {
    const Grid& g = grid();
    const auto [low, high] = solid.box(body_from_tool);
    const double edge = brick_edge * g.spacing;
    BrickBox box;
    const auto range = [&](std::size_t axis, double a, double b, double origin) {
        box.first[axis] = std::max(0, static_cast<int>(std::floor((a - band - origin) / edge)) - 1);
        box.last[axis] = std::min(g.bricks[axis] - 1, static_cast<int>(std::floor((b + band - origin) / edge)));
    };
    range(0, low.x, high.x, g.origin.x);
    range(1, low.y, high.y, g.origin.y);
    range(2, low.z, high.z, g.origin.z);
    return box;
}

std::size_t CutField::stamp_pose(const Pose& body_from_tool, const ToolSolid& solid, std::size_t next, int maximum,
                                 int& touched) {
    const Grid& g = grid();
    const BrickBox box = bricks_near(solid, body_from_tool, PoseStamp::band(g.spacing));

    // Collect bricks with bone in blocks: `stamp_bricks` tests a whole block at a time.
    PoseStamp stamp(g, solid, body_from_tool, &memory_);
    PointBlock centres;
    std::array<std::array<int, 3>, block_capacity> brick_coordinates_of_block;
    std::array<std::size_t, block_capacity> numbers;
    const double half = 0.5 * brick_edge * g.spacing;
    const std::size_t end = box.count();
    std::array<int, 3> place = next < end ? box[next] : box.first;
    for (std::size_t n = next; n < end || centres.count > 0; ++n) {
        if (n < end) {
            const auto [i, j, k] = place;
            box.next_brick(place);
            if (body_->surface.is_all_air(g.brick_index(i, j, k))) continue;
            const Vec3 low = g.sample_position(i * brick_edge, j * brick_edge, k * brick_edge);
            brick_coordinates_of_block[centres.count] = {i, j, k};
            numbers[centres.count] = n;
            centres.add(low + Vec3{half, half, half});
        }
        if (n + 1 < end && centres.count < block_capacity) continue;
        const std::size_t processed = stamp_bricks(stamp, centres, brick_coordinates_of_block.data(), maximum, touched);
        if (processed < centres.count) return numbers[processed];
        centres.count = 0;
    }
    return StampProgress::to_the_end;
}

std::size_t CutField::clear_ridges(const Sweep& sweep, const ToolSolid& solid, const CutRecord& record,
                                   std::size_t next, int maximum, int& touched) noexcept {
    // A sample on a ridge lies just outside of a sub-pose. So that sub-pose has already stored the sample's brick.
    const Grid& g = grid();
    const auto below = [&](double depth) {
        return static_cast<std::int16_t>(-std::min(static_cast<int>(depth / quantum_) + 2, 32767));
    };
    const std::int16_t lowest_anywhere = below(sweep.step());
    // A sample that the sweep passed can lie outside the last pose. Ahead of the solid's back end this happens only if
    // a face has receded from the sample, which bounds its distance to the last pose.
    const Pose end_from_body = inverse(record.to);
    const std::int16_t lowest_before_end =
        !solid.is_convex()
            ? lowest_anywhere
            : std::max(lowest_anywhere, below(solid.max_depth_gain_outside(inverse(record.from) * record.to)));
    const Vec3 forwards = rotate(conjugate(end_from_body.rotation), {0, 0, 1});  // of the tool, body frame
    const double half_cell = (4.0 * std::abs(forwards.x) + std::abs(forwards.y) + std::abs(forwards.z)) * g.spacing;
    const double end = solid.end_z() - end_from_body.position.z + sweep.step() * sweep.sub_poses() + half_cell;
    const auto lowest_in = [&](Vec3 middle_of_cell) {
        return dot(forwards, middle_of_cell) > end ? lowest_before_end : lowest_anywhere;
    };
    const double tolerance = 0.5 * quantum_;
    RidgeBlock ridge(sweep, tolerance);
    const auto clear_block = [&] {
        ridge.for_each_contained([&](std::size_t index, std::uint16_t place) {
            brick(start_[index])[place] = 1;
            changed_[index] = 1;
        });
    };
    const BrickBox a = bricks_near(solid, record.from, 0.0), b = bricks_near(solid, record.to, 0.0);
    BrickBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.first[axis] = std::min(a.first[axis], b.first[axis]);
        box.last[axis] = std::max(a.last[axis], b.last[axis]);
    }
    int quarters = 0;
    const std::size_t count = box.count();
    std::array<int, 3> place = next < count ? box[next] : box.first;
    for (std::size_t n = next; n < count; ++n) {
        if (touched >= maximum) {
            clear_block();
            return n;
        }
        const auto [i, j, k] = place;
        box.next_brick(place);
        const std::size_t index = g.brick_index(i, j, k);
        if (start_[index] == uncut || is_full_[index] != 0) continue;
        if (++quarters % 4 == 0) ++touched;
        const std::int16_t* samples = brick(start_[index]);
        const BrickCells& cells = cells_of(index);
        for (std::size_t cell = 0; cell < BrickCells::count; ++cell) {
            if (cells.lowest[cell] > 0 || cells.highest[cell] < lowest_anywhere) continue;
            const CellPosition at = CellPosition::of(cell);
            const std::int16_t lowest = lowest_in(g.sample_position(i * brick_edge + 4, j * brick_edge + at.first_y + 1,
                                                                    k * brick_edge + at.first_z + 1));
            if (cells.highest[cell] < lowest) continue;
            std::uint32_t found[3];
            block_kernel().find(samples + at.first_sample(), lowest, 0, found);
            for (int layer = 0; layer < 3; ++layer)
                for (std::uint32_t left = found[layer]; left != 0; left &= left - 1) {
                    const int bit = std::countr_zero(left), x = bit % stored_edge, y = at.first_y + bit / stored_edge,
                              z = at.first_z + layer;
                    const std::array<int, 3> in_grid{i * brick_edge + x, j * brick_edge + y, k * brick_edge + z};
                    bool is_in_region = true;
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        is_in_region = is_in_region && in_grid[axis] >= first_[axis] && in_grid[axis] <= last_[axis];
                    if (!is_in_region) continue;
                    ridge.add(g.sample_position(in_grid[0], in_grid[1], in_grid[2]), index,
                              static_cast<std::uint16_t>((z * stored_edge + y) * stored_edge + x));
                    if (ridge.is_full()) clear_block();
                }
        }
    }
    clear_block();
    return StampProgress::to_the_end;
}

std::size_t CutField::stamp_bricks(PoseStamp& stamp, const PointBlock& centres,
                                   const std::array<int, 3>* brick_coordinates_of_block, int maximum, int& touched) {
    const double h = grid().spacing;
    const double reach = 0.5 * brick_edge * std::sqrt(3.0) * h + PoseStamp::band(h);
    BlockValues depth;
    stamp.depths_of(centres, depth);
    for (std::size_t n = 0; n < centres.count; ++n) {
        if (-depth[n] >= reach) continue;
        const auto [i, j, k] = brick_coordinates_of_block[n];
        if (!stamp.may_reach(i, j, k)) continue;
        if (touched >= maximum) return n;
        const std::size_t index = grid().brick_index(i, j, k);
        if (start_[index] == uncut) open_brick(index);
        ++touched;  // also for full bricks, so that the count does not depend on earlier cuts
        if (is_full_[index] != 0) continue;
        std::int16_t* samples = brick(start_[index]);
        BrickCells& cells = cells_of(index);
        if (!stamp.raise(samples, cells, i, j, k, first_, last_)) continue;
        changed_[index] = 1;
        is_full_[index] =
            std::all_of(cells.lowest.begin(), cells.lowest.end(), [](std::int16_t s) { return s == 32767; });
    }
    return centres.count;
}

std::int16_t CutField::sample(int i, int j, int k) const noexcept {
    const Grid& g = grid();
    if (i < 0 || j < 0 || k < 0 || i >= g.samples(0) || j >= g.samples(1) || k >= g.samples(2)) return -32767;
    return brick(start_[g.brick_index(i / brick_edge, j / brick_edge, k / brick_edge)])
        [((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge];
}

std::vector<std::size_t> CutField::take_changed() {
    std::vector<std::size_t> bricks;
    constexpr std::size_t at_once = sizeof(std::uint64_t);
    for (std::size_t b = 0; b < changed_.size();) {
        std::uint64_t eight = 1;
        if (b + at_once <= changed_.size()) std::memcpy(&eight, &changed_[b], at_once);
        if (eight == 0) {
            b += at_once;
            continue;
        }
        if (changed_[b] != 0) bricks.push_back(b);
        changed_[b++] = 0;
    }
    return bricks;
}

std::uint64_t CutField::hash() const noexcept {
    Fnv1a hash;
    for (std::size_t b = 0; b < start_.size(); ++b) {
        const std::int16_t* v = stored(b);
        if (v == nullptr) continue;
        for (int s = 0; s < stored_samples; ++s)
            if (v[s] != -32767) {
                hash.add_bytes(b, 8);
                hash.add_bytes(static_cast<std::uint64_t>(s), 4);
                hash.add_bytes(static_cast<std::uint16_t>(v[s]), 2);
            }
    }
    return hash.value();
}

bool CutField::same_in(std::size_t brick_index, const CutField& other) const noexcept {
    const std::int16_t *mine = stored(brick_index), *theirs = other.stored(brick_index);
    if (mine == nullptr && theirs == nullptr) return true;
    if (mine != nullptr && theirs != nullptr)
        return std::memcmp(mine, theirs, stored_samples * sizeof(std::int16_t)) == 0;
    const std::int16_t* some = mine != nullptr ? mine : theirs;
    return std::all_of(some, some + stored_samples, [](std::int16_t s) { return s == -32767; });
}

bool CutField::same_bits(const CutField& other) const noexcept {
    if (start_.size() != other.start_.size()) return false;
    for (std::size_t b = 0; b < start_.size(); ++b)
        if (!same_in(b, other)) return false;
    return true;
}

std::vector<std::size_t> CutField::differing_bricks(const CutField& other) const {
    std::vector<std::size_t> bricks;
    for (std::size_t b = 0; b + 1 < start_.size(); ++b)
        if (!same_in(b, other)) bricks.push_back(b);
    return bricks;
}

}  // namespace kerf
