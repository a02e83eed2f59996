// SPDX-License-Identifier: Apache-2.0
#include "devices/motion/motion.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "kerf/assert.hpp"

namespace kerf::motion {

Motion::Motion(std::vector<MotionRow> rows) : rows_(std::move(rows)) {
    KERF_ASSERT(!rows_.empty(), "a motion needs a row; parse_motion() refuses a text without one");
    std::uint32_t pressed = 0;
    for (const MotionRow& row : rows_) pressed |= row.buttons;
    button_count_ = static_cast<std::uint32_t>(std::bit_width(pressed));
}

MotionRow Motion::at(std::uint64_t millisecond) const noexcept {
    // Divided, not multiplied by 1e-3: so the time is the one that a file writes with three digits.
    const double time = static_cast<double>(millisecond) / 1000.0;
    const auto later =
        std::upper_bound(rows_.begin(), rows_.end(), time, [](double t, const MotionRow& row) { return t < row.time; });
    MotionRow row = later == rows_.begin() ? rows_.front() : *(later - 1);
    if (time > rows_.back().time) row.buttons = 0;
    return row;
}

}  // namespace kerf::motion
