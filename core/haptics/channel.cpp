// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/channel.h"

#include <algorithm>
#include <cmath>

#include "kerf/exact_math.hpp"

namespace kerf {

ChannelForce channel_force(const kerf_channel& c, double s, double dt) noexcept {
    switch (c.kind) {
        case KERF_CUT: {
            const double past = s - c.gap / dt;
            if (past <= 0.0) return {};
            const double fading = exp_exact(-past / c.w);
            return {c.tau * (1.0 - fading) + c.eta * past, c.tau / c.w * fading + c.eta};
        }
        case KERF_CONTACT: {
            const double force = c.k * (c.delta + s * dt) + c.b * (s + std::min(c.delta, 0.0) / dt);
            return force > 0.0 ? ChannelForce{force, c.k * dt + c.b} : ChannelForce{};
        }
        case KERF_FRICTION:
            if (s >= c.w) return {c.tau, 0.0};
            if (s <= -c.w) return {-c.tau, 0.0};
            return {c.tau * s / c.w, c.tau / c.w};
        case KERF_HOLD:
            return {c.k * (c.delta + s * dt) + c.b * s, c.k * dt + c.b};
        default:
            return {};
    }
}

kerf_channel contact_channel(OwnContact what, const Vec6& d, double stiffness, double depth) noexcept {
    kerf_channel channel{};
    channel.kind = KERF_CONTACT;
    channel.id = static_cast<std::uint32_t>(what);
    std::copy(d.begin(), d.end(), channel.d);
    channel.w = 1e-6;
    channel.k = stiffness;
    channel.delta = depth;
    return channel;
}

bool is_sound(const kerf_channel& c) noexcept {
    double size = 0.0;
    for (int i = 0; i < 6; ++i) {
        if (!std::isfinite(c.d[i]) || !std::isfinite(c.follow[i])) return false;
        size += c.d[i] * c.d[i];
    }
    // Written so that a NaN fails.
    const auto is_coefficient = [](double v) { return v >= 0.0 && std::isfinite(v); };
    const bool has_width = (c.kind != KERF_CUT && c.kind != KERF_FRICTION) || (c.w >= 1e-6 && std::isfinite(c.w));
    return c.kind <= KERF_HOLD && size > 0.0 && is_coefficient(c.tau) && is_coefficient(c.eta) &&
           is_coefficient(c.gap) && is_coefficient(c.k) && is_coefficient(c.b) && std::isfinite(c.delta) && has_width;
}

}  // namespace kerf
