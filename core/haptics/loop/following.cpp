// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/following.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

/// Returns the larger of two ratios: the length of `v` across the shaft, and along it, to its limit.
double used_fraction(Split limit, Vec3 v) noexcept {
    return std::max(length(Vec3{v.x, v.y, 0.0}) / limit.across, std::abs(v.z) / limit.along);
}

}  // namespace

double Following::lambda_of(std::uint32_t id) const noexcept {
    for (std::size_t f = 0; f < count_; ++f)
        if (filtered_[f].id == id) return filtered_[f].lambda;
    return 0.0;
}

Vec6 Following::wrench(const Balance& balance, const Vec6& own) const noexcept {
    Vec6 sum = own;
    for (const auto& channel : balance.channels) {
        const double lambda = lambda_of(channel.id);
        for (std::size_t i = 0; i < 6; ++i) sum[i] += channel.follow[i] * lambda;
    }
    const Vec3 force = linear(sum), about_centre = angular(sum) - cross(balance.centre, force);
    const double use =
        std::max(used_fraction(balance.force.limit, force), used_fraction(balance.torque.limit, about_centre));
    if (use > 0.5)
        for (double& component : sum) component *= 0.5 / use;
    return sum;
}

void Following::update(const Balance& balance, const Motion& motion) noexcept {
    const Split of_force = 1.0 / balance.force.drag;
    const double of_torque =
        1.0 / (balance.torque.drag.across + balance.force.drag.across * dot(balance.centre, balance.centre));
    const auto weighed = [&](const double* wrench) {
        const Vec3 force{wrench[0], wrench[1], wrench[2]}, torque{wrench[3], wrench[4], wrench[5]};
        return dot(force, of_force * force) + of_torque * dot(torque, torque);
    };
    double mu2 = 0.0;
    for (const auto& channel : balance.channels) mu2 = std::max(mu2, weighed(channel.follow) / weighed(channel.d));
    const double alpha = 1.0 / (1.0 + mu2);
    std::array<Filtered, max_balance_channels> next{};
    for (std::size_t c = 0; c < balance.channels.size(); ++c) {
        const double old = lambda_of(balance.channels[c].id);
        next[c] = {balance.channels[c].id, old + alpha * (motion.lambda[c] - old)};
    }
    filtered_ = next;
    count_ = balance.channels.size();
}

}  // namespace kerf
