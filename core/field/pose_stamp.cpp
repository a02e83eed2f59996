// SPDX-License-Identifier: Apache-2.0
#include "core/field/pose_stamp.h"

#include <algorithm>

namespace kerf {

void PoseStamp::start_rows(int j, int k) noexcept {
    if (at_j_ == j && at_k_ == k) return;
    at_j_ = j;
    at_k_ = k;
    PointBlock in_body[3];
    for (int z = 0; z < stored_edge; ++z)
        for (int y = 0; y < stored_edge; ++y)
            in_body[z / 3].add(grid_->sample_position(0, j * brick_edge + y, k * brick_edge + z));
    for (int layers : {0, 1, 2}) transform(tool_from_body_, in_body[layers], starts_[layers]);
}

bool PoseStamp::raise_cells(std::int16_t* samples, CellRanges& ranges, int i) const noexcept {
    std::array<double, stored_edge> x, y, z;  // from the start of a row to its samples
    for (int n = 0; n < stored_edge; ++n) {
        const Vec3 along = static_cast<double>(i * brick_edge + n) * step_;
        x[n] = along.x;
        y[n] = along.y;
        z[n] = along.z;
    }

    PointBlock middles;
    for (std::size_t cell = 0; cell < CellRanges::count; ++cell) {
        const CellPlace at = CellPlace::of(cell);
        const double middle = static_cast<double>(i * brick_edge) + 0.5 * (at.first_x + at.last_x);
        middles.add(starts_[at.first_z / 3][static_cast<std::size_t>(stored_edge + at.first_y + 1)] + middle * step_);
    }
    // How deep can any sample of a cell be? No deeper than a plane that touches the solid; or, since the distance is
    // 1-Lipschitz, than the middle by as much as it lies from there.
    BlockValues depth;
    PointBlock gradient;
    const bool has_tangents = solid_->is_convex();
    if (has_tangents)
        solid_->tangents(middles, depth, gradient);
    else
        solid_->depths(middles, depth);
    const double quantum = grid_->quantum(), per_quantum = 1.0 / quantum;
    const double radius[2] = {std::sqrt(4.25) * grid_->spacing, std::sqrt(6.0) * grid_->spacing};
    constexpr double far = 1e5;  // [quanta], beyond all that is stored and within what float tells apart
    const double lowest_kept = -band_ * per_quantum - 2.0;
    bool is_changed = false;
    for (std::size_t cell = 0; cell < CellRanges::count; ++cell) {
        if (ranges.lowest[cell] == 32767) continue;
        const CellPlace at = CellPlace::of(cell);
        const double half_width = 0.5 * (at.last_x - at.first_x), middle_x = at.first_x + half_width;
        double per_x = 0.0, per_y = 0.0, per_z = 0.0, base = (depth[cell] + radius[cell % 2]) * per_quantum, deepest = base;
        if (has_tangents) {
            const Vec3 g = per_quantum * gradient[cell];
            per_x = dot(g, step_);
            per_y = dot(g, step_y_);
            per_z = dot(g, step_z_);
            base = depth[cell] * per_quantum;
            deepest = base + half_width * std::abs(per_x) + std::abs(per_y) + std::abs(per_z);
            base = std::clamp(base, -far, far) - middle_x * per_x - (at.first_y + 1) * per_y - per_z;
        }
        if (deepest < lowest_kept || ranges.lowest[cell] >= deepest + 2.0) continue;
        const PointBlock& starts = starts_[at.first_z / 3];
        const SampleCell which{starts.coordinates(),
                               {x.data(), y.data(), z.data()},
                               at.first_x,
                               at.last_x,
                               at.first_y,
                               static_cast<float>(base),
                               static_cast<float>(per_x),
                               static_cast<float>(per_y),
                               static_cast<float>(per_z)};
        if (solid_->raise(which, band_, quantum, samples + at.first_z * stored_edge * stored_edge, ranges.lowest[cell],
                          ranges.highest[cell]))
            is_changed = true;
    }
    return is_changed;
}

bool PoseStamp::raise(std::int16_t* samples, CellRanges& ranges, int i, int j, int k, const std::array<int, 3>& first,
                      const std::array<int, 3>& last) noexcept {
    start_rows(j, k);
    const int low[] = {i * brick_edge, j * brick_edge, k * brick_edge};
    bool is_all_within = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
        is_all_within = is_all_within && low[axis] >= first[axis] && low[axis] + brick_edge <= last[axis];
    if (is_all_within) return raise_cells(samples, ranges, i);

    // Some samples must stay: raise all, elsewhere, and take over the others.
    std::array<std::int16_t, stored_samples> raised;
    std::copy_n(samples, stored_samples, raised.data());
    if (!raise_cells(raised.data(), ranges, i)) return false;
    bool is_changed = false;
    for (std::size_t cell = 0; cell < CellRanges::count; ++cell) {
        const CellPlace at = CellPlace::of(cell);
        int lowest = 32767, highest = -32767;
        for (int z = at.first_z; z < at.first_z + 3; ++z)
            for (int y = at.first_y; y < at.first_y + 3; ++y)
                for (int x = at.first_x; x <= at.last_x; ++x) {
                    const auto place = static_cast<std::size_t>((z * stored_edge + y) * stored_edge + x);
                    if (low[0] + x >= first[0] && low[0] + x <= last[0] && low[1] + y >= first[1] &&
                        low[1] + y <= last[1] && low[2] + z >= first[2] && low[2] + z <= last[2]) {
                        is_changed = is_changed || samples[place] != raised[place];
                        samples[place] = raised[place];
                    }
                    lowest = std::min<int>(lowest, samples[place]);
                    highest = std::max<int>(highest, samples[place]);
                }
        ranges.lowest[cell] = static_cast<std::int16_t>(lowest);
        ranges.highest[cell] = static_cast<std::int16_t>(highest);
    }
    return is_changed;
}

}  // namespace kerf
