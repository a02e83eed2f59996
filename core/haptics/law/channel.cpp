// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/channel.h"

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
        case KERF_HOLD: {
            const double force = c.k * (c.delta + s * dt) + c.b * s;
            if (c.tau > 0.0 && std::abs(force) >= c.tau) return {std::copysign(c.tau, force), 0.0};
            return {force, c.k * dt + c.b};
        }
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

ChannelFault fault_of(const kerf_channel& c) noexcept {
    constexpr const char *finite = "a finite number", *coefficient = "a finite number, 0 or more";
    constexpr const char* d_names[] = {"d[0]", "d[1]", "d[2]", "d[3]", "d[4]", "d[5]"};
    constexpr const char* follow_names[] = {"follow[0]", "follow[1]", "follow[2]",
                                            "follow[3]", "follow[4]", "follow[5]"};
    if (c.kind > KERF_HOLD)
        return {"kind", "0 (cut), 1 (contact), 2 (friction) or 3 (hold)", static_cast<double>(c.kind)};
    constexpr double max_follow = 1e6;  // [–] or [m]: far beyond any cutter, of which a channel may take a small part
    double size = 0.0;
    for (int i = 0; i < 6; ++i) {
        if (!std::isfinite(c.d[i])) return {d_names[i], finite, c.d[i]};
        if (!(std::abs(c.follow[i]) <= max_follow))
            return {follow_names[i], "a number from -1e+06 to 1e+06", c.follow[i]};
        size += c.d[i] * c.d[i];
    }
    if (!(size > 0.0)) return {"d", "a direction, which is not zero", size};
    // These comparisons are false for a NaN, so it is rejected.
    const auto is_coefficient = [](double v) { return v >= 0.0 && std::isfinite(v); };
    if (!is_coefficient(c.tau)) return {"tau", coefficient, c.tau};
    if (!is_coefficient(c.eta)) return {"eta", coefficient, c.eta};
    if (!is_coefficient(c.gap)) return {"gap", coefficient, c.gap};
    if (!is_coefficient(c.k)) return {"k", coefficient, c.k};
    if (!is_coefficient(c.b)) return {"b", coefficient, c.b};
    if (!std::isfinite(c.delta)) return {"delta", finite, c.delta};
    const bool has_width = c.kind == KERF_CUT || c.kind == KERF_FRICTION;
    if (has_width && !(c.w >= 1e-6 && std::isfinite(c.w))) return {"w", "1e-06 or more, finite", c.w};
    return {};
}

}  // namespace kerf
