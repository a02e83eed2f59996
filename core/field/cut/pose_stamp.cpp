// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/pose_stamp.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

/// Returns whether cells should be compared with earlier stamps. Near a blade most cells change with every record, and
/// the test takes longer than it saves.
bool uses_memory(const ToolSolid& solid) noexcept { return solid.is_convex() && !solid.is_prism(); }

constexpr int rounding = 2;  // [quanta]
/// Returns whether comparing a cell with an earlier stamp may pay off. A cell with less to spare rose with that stamp,
/// and most likely rises again.
bool is_worth_testing(std::int16_t spare) noexcept { return spare > rounding; }

}  // namespace

PoseStamp::PoseStamp(const Grid& grid, const ToolSolid& solid, const Pose& body_from_tool, StampMemory* memory) noexcept
    : grid_(&grid),
      solid_(&solid),
      memory_(uses_memory(solid) ? memory : nullptr),
      tool_from_body_(inverse(body_from_tool)),
      band_(band(grid.spacing)) {
    const Vec3 tip = (1.0 / grid.spacing) * (body_from_tool * Vec3{0, 0, solid.tip_z()} - grid.origin);
    const double at[3] = {tip.x, tip.y, tip.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        anchor_[axis] = static_cast<int>(std::clamp(at[axis], 0.0, static_cast<double>(grid.samples(axis))));
    origin_ = tool_from_body_ * grid.sample_position(anchor_[0], anchor_[1], anchor_[2]);
    const Vec3 axes[3] = {{grid.spacing, 0, 0}, {0, grid.spacing, 0}, {0, 0, grid.spacing}};
    const auto single = [](Vec3 v, float(&to)[3]) {
        to[0] = static_cast<float>(v.x);
        to[1] = static_cast<float>(v.y);
        to[2] = static_cast<float>(v.z);
    };
    single(origin_, single_origin_);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        along_[axis] = rotate(tool_from_body_.rotation, axes[axis]);
        single(along_[axis], single_along_[axis]);
    }
}

bool PoseStamp::may_reach(int i, int j, int k) const noexcept {
    if (!solid_->is_prism()) return true;
    constexpr double half = 0.5 * brick_edge;
    const auto place = [&](int at, std::size_t axis) {
        return static_cast<double>(at * brick_edge - anchor_[axis]) + half;
    };
    const Vec3 middle = origin_ + place(i, 0) * along_[0] + place(j, 1) * along_[1] + place(k, 2) * along_[2];
    const auto [x, y, z] = along_;
    const Vec3 extent{half * (std::abs(x.x) + std::abs(y.x) + std::abs(z.x)),
                      half * (std::abs(x.y) + std::abs(y.y) + std::abs(z.y)),
                      half * (std::abs(x.z) + std::abs(y.z) + std::abs(z.z))};
    return solid_->deepest_in(middle, extent) >= -band_ - 2.0 * grid_->quantum();
}

SampleCell PoseStamp::cell_at(int i, int j, int k) const noexcept {
    SampleCell cell{};
    cell.has_edges = true;
    const int at[3] = {i, j, k};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cell.origin[axis] = single_origin_[axis];
        std::copy_n(single_along_[axis], 3, cell.along[axis]);
        cell.first[axis] = static_cast<float>(at[axis] * brick_edge - anchor_[axis]);
    }
    return cell;
}

const PoseStamp::Motion* PoseStamp::motion_since(std::uint32_t number) noexcept {
    if (memory_ == nullptr || number == 0) return nullptr;
    Motion& motion = motions_[number % motions_.size()];
    if (motion.since != number) {
        motion = {};
        motion.since = number;
        const StampMemory::Stamped* then = memory_->find(number);
        if (then == nullptr || then->solid != solid_->shape_hash()) return nullptr;
        const Pose then_from_now = then->tool_from_body * inverse(tool_from_body_);
        const Quat& q = then_from_now.rotation;
        motion.shift = -then_from_now.position;
        motion.turn = (q.w < 0.0 ? 2.0 : -2.0) * Vec3{q.x, q.y, q.z};  // 2 sin(θ/2) instead of θ
        motion.turned = length(motion.turn);
        motion.error = motion.turned * motion.turned;
        motion.is_known = motion.turned < 0.1;
    }
    return motion.is_known ? &motion : nullptr;
}

double PoseStamp::max_depth_gain(const Motion& motion, Vec3 middle, Vec3 half) const noexcept {
    const double size = length(half), spread = motion.turned * size + motion.error * (length(middle) + size);
    const double gained = solid_->max_depth_gain(middle, half, motion.shift + cross(motion.turn, middle), spread,
                                                 grid_->clamp() + grid_->quantum());
    return gained / grid_->quantum() + rounding;
}

Vec3 PoseStamp::extent(double along_x, double across) const noexcept {
    const auto [x, y, z] = along_;
    const auto reach = [&](double in_x, double in_y, double in_z) {
        return along_x * std::abs(in_x) + across * (std::abs(in_y) + std::abs(in_z));
    };
    return {reach(x.x, y.x, z.x), reach(x.y, y.y, z.y), reach(x.z, y.z, z.z)};
}

bool PoseStamp::cannot_rise(const BrickCells& cells, int i, int j, int k) noexcept {
    const Motion* since = motion_since(cells.compared);
    if (since == nullptr) return false;
    const std::int16_t minimum = *std::min_element(cells.spare.begin(), cells.spare.end());
    constexpr double half = 0.5 * brick_edge;
    return is_worth_testing(minimum) && max_depth_gain(*since, position_in(cell_at(i, j, k), half, half, half),
                                                       extent(half, half)) <= static_cast<double>(minimum);
}

bool PoseStamp::raise_cells(std::int16_t* samples, BrickCells& cells, int i, int j, int k) noexcept {
    if (cannot_rise(cells, i, j, k)) return false;
    if (memory_ != nullptr && number_ == 0) number_ = memory_->add(*solid_, tool_from_body_);
    const Motion* since = motion_since(cells.compared);
    SampleCell cell = cell_at(i, j, k);

    // Compute upper bounds of the depth of each cell's samples. For a convex solid: from its tangent plane at the
    // cell's centre. Else: the depth of the centre plus the distance from there, as the depth is 1-Lipschitz.
    PointBlock middles;
    for (std::size_t n = 0; n < BrickCells::count; ++n) {
        const CellPosition at = CellPosition::of(n);
        middles.add(position_in(cell, 4.0, at.first_y + 1.0, at.first_z + 1.0));
    }
    BlockValues depth;
    PointBlock gradient;
    const bool has_tangents = solid_->is_convex();
    if (has_tangents)
        solid_->tangents(middles, depth, gradient);
    else
        solid_->depths(middles, depth);
    const double quantum = grid_->quantum(), per_quantum = 1.0 / quantum, radius = std::sqrt(18.0) * grid_->spacing;
    const double lowest_kept = -band_ * per_quantum - 2.0;
    const SingleOutline whole = solid_->single();
    const float first[2] = {cell.first[1], cell.first[2]};
    bool is_changed = false;
    const Vec3 half = extent(4.0, 1.0);
    for (std::size_t n = 0; n < BrickCells::count; ++n) {
        const auto keep = [&](double spare) { cells.spare[n] = static_cast<std::int16_t>(std::min(spare, 32767.0)); };
        if (cells.lowest[n] == 32767) {
            keep(32767.0);
            continue;
        }
        double deepest = depth[n] + radius;
        if (has_tangents) {
            const auto along = [&](std::size_t axis) { return std::abs(dot(gradient[n], along_[axis])); };
            deepest = depth[n] + 4.0 * along(0) + along(1) + along(2);
        }
        deepest *= per_quantum;
        if (const double spare = std::max<double>(lowest_kept, cells.lowest[n] - 2.0) - deepest; spare >= 0.0) {
            keep(spare);
            continue;
        }
        if (since != nullptr && is_worth_testing(cells.spare[n])) {
            if (const double spare = cells.spare[n] - max_depth_gain(*since, middles[n], half); spare >= 0.0) {
                keep(spare);
                continue;
            }
        }
        const CellPosition at = CellPosition::of(n);
        cell.first[1] = first[0] + static_cast<float>(at.first_y);
        cell.first[2] = first[1] + static_cast<float>(at.first_z);
        const SingleOutline outline =
            solid_->is_prism() ? solid_->faces_near(whole, middles[n].x, half.x, grid_->clamp() + band_) : whole;
        cell.has_edges = solid_->has_edge_within(middles[n], half, 2.0 * band_ + 0.1 * grid_->spacing);
        if (block_kernel().raise(outline, cell, static_cast<float>(band_), static_cast<float>(per_quantum),
                                 samples + at.first_sample(), cells.lowest[n], cells.highest[n],
                                 memory_ != nullptr ? &cells.spare[n] : nullptr))
            is_changed = true;
    }
    cells.compared = number_;
    return is_changed;
}

bool PoseStamp::raise(std::int16_t* samples, BrickCells& cells, int i, int j, int k, const std::array<int, 3>& first,
                      const std::array<int, 3>& last) noexcept {
    const int low[] = {i * brick_edge, j * brick_edge, k * brick_edge};
    bool is_all_within = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
        is_all_within = is_all_within && low[axis] >= first[axis] && low[axis] + brick_edge <= last[axis];
    if (is_all_within) return raise_cells(samples, cells, i, j, k);

    // Samples outside `first` … `last` must not change: raise a copy, and take only the others from it.
    std::array<std::int16_t, stored_samples> raised;
    std::copy_n(samples, stored_samples, raised.data());
    if (!raise_cells(raised.data(), cells, i, j, k)) return false;
    bool is_changed = false;
    for (std::size_t cell = 0; cell < BrickCells::count; ++cell) {
        const CellPosition at = CellPosition::of(cell);
        int lowest = 32767, highest = -32767;
        for (int z = at.first_z; z < at.first_z + 3; ++z)
            for (int y = at.first_y; y < at.first_y + 3; ++y)
                for (int x = 0; x < stored_edge; ++x) {
                    const auto place = static_cast<std::size_t>((z * stored_edge + y) * stored_edge + x);
                    if (low[0] + x >= first[0] && low[0] + x <= last[0] && low[1] + y >= first[1] &&
                        low[1] + y <= last[1] && low[2] + z >= first[2] && low[2] + z <= last[2]) {
                        is_changed = is_changed || samples[place] != raised[place];
                        samples[place] = raised[place];
                    }
                    lowest = std::min<int>(lowest, samples[place]);
                    highest = std::max<int>(highest, samples[place]);
                }
        cells.lowest[cell] = static_cast<std::int16_t>(lowest);
        cells.highest[cell] = static_cast<std::int16_t>(highest);
    }
    return is_changed;
}

}  // namespace kerf
