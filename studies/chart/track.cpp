// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/track.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "studies/times.h"

namespace kerf::chart {

namespace {

constexpr double as_good_as_none = 1e-3;  // [N]

}  // namespace

double ErrorSum::Squares::ratio() const noexcept { return right > 0.0 ? std::sqrt(wrong / right) : 0.0; }

void ErrorSum::add(const Track& track) {
    Squares own;
    double largest = 0.0, step = 0.0;
    Vec3 last_difference{0, 0, 0};
    bool has_last = false;
    for (std::size_t t = 0; t < track.felt.size(); ++t) {
        costs_.push_back(track.felt[t].cost);
        Vec3 force = linear(track.felt[t].wrench), reference = linear(track.reference[t]);
        measured_.is_finite = measured_.is_finite && is_finite(force);
        if (!is_finite(force) || !track.is_compared[t]) {
            has_last = false;
            continue;
        }
        if (thrust_alone_) {
            force = {0, 0, force.z};
            reference = {0, 0, reference.z};
        } else {
            if (std::hypot(reference.x, reference.y) < 1.0)
                measured_.off_lateral = std::max(measured_.off_lateral, std::hypot(force.x, force.y));
            if (length(reference) < as_good_as_none) measured_.off_none = std::max(measured_.off_none, length(force));
        }
        const Vec3 difference = force - reference;
        own.wrong += dot(difference, difference);
        own.right += dot(reference, reference);
        if (track.is_exact.empty() || track.is_exact[t]) {
            exact_.wrong += dot(difference, difference);
            exact_.right += dot(reference, reference);
            exact_ticks_ += 1.0;
        }
        if (line_) {
            const double right = line_->torque(track.reference[t]), wrong = line_->torque(track.felt[t].wrench) - right;
            torque_.wrong += wrong * wrong;
            torque_.right += right * right;
        }
        largest = std::max(largest, length(reference));
        if (has_last) step = std::max(step, length(difference - last_difference));
        last_difference = difference;
        has_last = true;
        ticks_ += 1.0;
    }
    all_.wrong += own.wrong;
    all_.right += own.right;
    measured_.worst_grid = std::max(measured_.worst_grid, std::sqrt(own.wrong / own.right));
    measured_.peak_step = std::max(measured_.peak_step, step / largest);
    measured_.volume_error += std::abs(track.volume - track.volume_reference) / track.volume_reference;
    ++tracks_;
}

Measured ErrorSum::measured() const {
    Measured measured = measured_;
    measured.force_error = std::sqrt(all_.wrong / all_.right);
    measured.volume_error /= tracks_;
    measured.reference = std::sqrt(all_.right / ticks_);
    measured.exact_share = exact_ticks_ / ticks_;
    measured.exact_error = exact_.ratio();
    measured.torque_error = torque_.ratio();
    measured.torque_reference = std::sqrt(torque_.right / ticks_);
    const Times times = times_of(costs_);
    measured.cost = {times.median, times.p999, times.longest};
    return measured;
}

}  // namespace kerf::chart
