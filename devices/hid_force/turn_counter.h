// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace kerf::hid_force {

/// The turn of an axis over any number of turns, from counts that begin again beyond the end of their range.
class TurnCounter {
public:
    /// @param angle  [rad] of the whole range; negative: the counts fall while the knob turns clockwise
    TurnCounter(std::int64_t min, std::int64_t max, double angle) noexcept
        : counts_(max - min + 1), angle_(angle / static_cast<double>(counts_)) {}

    /// Largest turn between two reports [rad]. A hand is slower: a larger one is a new middle, set by a maker's
    /// program.
    static constexpr double max_step = 1.0;

    /// Takes counts of the range. Of two ways round it counts the shorter one, and it ignores a jump. Returns the turn
    /// [rad], 0 after the first.
    double take(std::int64_t counts) noexcept {
        if (has_last_) {
            std::int64_t change = counts - last_;
            if (2 * change > counts_) change -= counts_;
            if (2 * change < -counts_) change += counts_;
            const double step = std::abs(static_cast<double>(change) * angle_);
            if (step <= std::max(max_step, resolution())) total_ += change;
        }
        last_ = counts;
        has_last_ = true;
        return turn();
    }
    /// Takes the next counts as the present turn: the device was away.
    void restart() noexcept { has_last_ = false; }
    [[nodiscard]] double turn() const noexcept { return static_cast<double>(total_) * angle_; }
    /// Returns the angle of one count [rad].
    [[nodiscard]] double resolution() const noexcept { return angle_ < 0.0 ? -angle_ : angle_; }

private:
    std::int64_t counts_;
    double angle_;  ///< [rad] of a count
    std::int64_t last_ = 0, total_ = 0;
    bool has_last_ = false;
};

}  // namespace kerf::hid_force
