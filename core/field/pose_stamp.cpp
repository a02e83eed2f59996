// SPDX-License-Identifier: Apache-2.0
#include "core/field/pose_stamp.h"

#include <algorithm>
#include <cstdlib>

namespace kerf {

void PoseStamp::start_rows(int j, int k) noexcept {
    if (at_j_ == j && at_k_ == k) return;
    at_j_ = j;
    at_k_ = k;
    PointBlock in_body[2];
    for (int z = 0; z < stored_edge; ++z)
        for (int y = 0; y < stored_edge; ++y)
            in_body[z < 5 ? 0 : 1].add(grid_->sample_position(0, j * brick_edge + y, k * brick_edge + z));
    for (int half : {0, 1}) transform(tool_from_body_, in_body[half], starts_[half]);
}

std::size_t PoseStamp::rows_that_matter(const std::int16_t* samples, int i, const std::array<int, 3>& first,
                                        const std::array<int, 3>& last,
                                        std::array<Row, rows_per_brick>& rows) const noexcept {
    // The distance is 1-Lipschitz: its value in the middle of a row says how deep any sample of it can be.
    const double half_row = 0.5 * brick_edge * grid_->spacing * (1.0 + 1e-9);
    const double to_middle = static_cast<double>(i * brick_edge) + 0.5 * brick_edge;
    const double quantum = grid_->quantum();
    std::size_t count = 0;
    for (std::size_t half = 0; half < 2; ++half) {
        PointBlock middle;
        BlockValues depth;
        shift(starts_[half], to_middle * step_, middle);
        solid_->depths(middle, depth);
        for (std::size_t n = 0; n < middle.count; ++n) {
            if (-depth[n] > band_ + half_row) continue;
            const std::size_t row = half * first_half + n;
            const int y = at_j_ * brick_edge + static_cast<int>(row) % stored_edge;
            const int z = at_k_ * brick_edge + static_cast<int>(row) / stored_edge;
            if (y < first[1] || y > last[1] || z < first[2] || z > last[2]) continue;
            const std::int16_t* v = samples + row * stored_edge;
            const std::int16_t lowest = *std::min_element(v, v + stored_edge);
            const double deepest = depth[n] / quantum + 2.0;  // rounded up
            if (lowest == 32767 || lowest >= deepest + half_row / quantum) continue;
            rows[count++] = {static_cast<std::uint8_t>(row), static_cast<std::int32_t>(std::min(deepest, 65535.0))};
        }
    }
    return count;
}

bool PoseStamp::raise(std::int16_t* samples, int i, int j, int k, const std::array<int, 3>& first,
                      const std::array<int, 3>& last) noexcept {
    start_rows(j, k);
    std::array<Row, rows_per_brick> rows;
    const std::size_t row_count = rows_that_matter(samples, i, first, last, rows);

    constexpr int a_voxel = 8192;  // quanta, rounded up
    constexpr int lowest_kept = -static_cast<int>(band_voxels) * a_voxel;
    std::array<Vec3, stored_edge> along;
    std::array<int, stored_edge> deeper;  // than the middle of its row [quanta], at most
    for (int x = 0; x < stored_edge; ++x) {
        along[x] = static_cast<double>(i * brick_edge + x) * step_;
        deeper[x] = a_voxel * std::abs(x - brick_edge / 2);
    }
    const int x_first = std::max(0, first[0] - i * brick_edge);
    const int x_last = std::min(stored_edge - 1, last[0] - i * brick_edge);

    PointBlock points;
    std::array<std::int16_t, block_capacity> values;
    std::array<std::uint16_t, block_capacity> places;
    bool is_changed = false;
    const auto raise_block = [&] {
        if (solid_->raise(points, band_, grid_->quantum(), values)) {
            is_changed = true;
            for (std::size_t n = 0; n < points.count; ++n) samples[places[n]] = values[n];
        }
        points.count = 0;
    };
    for (std::size_t n = 0; n < row_count; ++n) {
        if (points.count + stored_edge > block_capacity) raise_block();
        const Vec3 start = start_of(rows[n].row);
        const std::size_t place = static_cast<std::size_t>(rows[n].row) * stored_edge;
        std::size_t at = points.count;
        for (int x = x_first; x <= x_last; ++x) {
            const int value = samples[place + static_cast<std::size_t>(x)], deepest = rows[n].deepest + deeper[x];
            values[at] = static_cast<std::int16_t>(value);
            places[at] = static_cast<std::uint16_t>(place + static_cast<std::size_t>(x));
            points.x[at] = start.x + along[x].x;
            points.y[at] = start.y + along[x].y;
            points.z[at] = start.z + along[x].z;
            // The next one is written over it if it cannot rise.
            at += (value < 32767) & (value < deepest) & (deepest > lowest_kept);
        }
        points.count = at;
    }
    raise_block();
    return is_changed;
}

}  // namespace kerf
