// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/following.h"

#include <algorithm>

namespace kerf {

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
    const Vec3 about_grip = angular(sum) - cross(balance.grip, linear(sum));
    const double use = std::max(length(linear(sum)) / balance.force.limit, length(about_grip) / balance.torque.limit);
    if (use > 0.5)
        for (double& component : sum) component *= 0.5 / use;
    return sum;
}

void Following::update(const Balance& balance, const Motion& motion) noexcept {
    const double force_compliance = 1.0 / balance.force.drag;
    const double turn_compliance = 1.0 / (balance.torque.drag + balance.force.drag * dot(balance.grip, balance.grip));
    double mu2 = 0.0;
    for (const auto& channel : balance.channels) {
        double d2 = 0.0, f2 = 0.0;
        for (std::size_t i = 0; i < 6; ++i) {
            const double weight = i < 3 ? force_compliance : turn_compliance;
            d2 += weight * channel.d[i] * channel.d[i];
            f2 += weight * channel.follow[i] * channel.follow[i];
        }
        mu2 = std::max(mu2, f2 / d2);
    }
    const double alpha = 1.0 / (1.0 + mu2);
    std::array<Filtered, most_channels> next{};
    for (std::size_t c = 0; c < balance.channels.size(); ++c) {
        const double old = lambda_of(balance.channels[c].id);
        next[c] = {balance.channels[c].id, old + alpha * (motion.lambda[c] - old)};
    }
    filtered_ = next;
    count_ = balance.channels.size();
}

}  // namespace kerf
