// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/math.hpp"

/// One monotone scalar channel of a law: its force, its slope and its validity.
namespace kerf {

/// Force and slope of a channel at the rate `s` along its direction.
struct ChannelForce {
    double lambda = 0.0;  ///< [N]
    double slope = 0.0;   ///< [N·s/m] ≥ 0
};

/// Returns λ(s) and its slope for a step of `dt` [s], as defined in kerf/abi.h. `s` [m/s] is the rate along the
/// channel's direction, dᵀu. λ never falls with s.   [any] pure, nonblocking.
///
/// Source: docs/design/tick.md, "The solve".
[[nodiscard]] ChannelForce channel_force(const kerf_channel& channel, double s, double dt) noexcept;

/// The first field of a channel with a value that the solve cannot use: its name, its expected range and its value.
/// `field` is null for a sound channel. Both texts are literals.
struct ChannelFault {
    const char* field = nullptr;
    const char* expected = "";
    double value = 0.0;
};
[[nodiscard]] ChannelFault fault_of(const kerf_channel& channel) noexcept;  // [any] pure, nonblocking

/// Returns whether the solve can use the channel: finite values, a non-zero direction, no negative coefficient.
/// [any] pure, nonblocking.
[[nodiscard]] inline bool is_sound(const kerf_channel& channel) noexcept { return fault_of(channel).field == nullptr; }

/// Ids of the contact channels that the host adds to the plugin's channels.
enum class OwnContact : std::uint32_t {
    held = 0xfffffe00u /* the first of its octants */,
    guide_front = 0xfffffffcu,
    guide_rear = 0xfffffffdu,
    metal = 0xfffffffeu,
    region = 0xffffffffu
};
/// Returns a contact channel of the host along `d` [–, m] with `stiffness` [N/m]. `depth` [m] is the penetration;
/// negative: minus the distance between the parts.   [any] pure, nonblocking.
[[nodiscard]] kerf_channel contact_channel(OwnContact what, const Vec6& d, double stiffness, double depth) noexcept;

[[nodiscard]] inline Vec6 direction(const kerf_channel& c) noexcept {
    return {c.d[0], c.d[1], c.d[2], c.d[3], c.d[4], c.d[5]};
}

}  // namespace kerf
