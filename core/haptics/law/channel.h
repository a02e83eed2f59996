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

/// Returns λ(s) of a channel as defined in kerf/abi.h, with the tick `dt` [s]. Non-decreasing in s.   [any] pure,
/// nonblocking.
///
/// Source: docs/design/tick.md, "The solve".
[[nodiscard]] ChannelForce channel_force(const kerf_channel& channel, double s, double dt) noexcept;

/// The first field of a channel that the solve cannot use, and its expected range, both as literals. `field` is null
/// for a sound channel.
struct ChannelFault {
    const char* field = nullptr;
    const char* expected = "";
    double value = 0.0;
};
[[nodiscard]] ChannelFault fault_of(const kerf_channel& channel) noexcept;  // [any] pure, nonblocking

/// Returns whether the solve can use the channel: finite values, a non-zero direction, no negative coefficient.
/// [any] pure, nonblocking.
[[nodiscard]] inline bool is_sound(const kerf_channel& channel) noexcept { return fault_of(channel).field == nullptr; }

/// Ids of the host's own contact channels, in addition to the plugin's channels.
enum class OwnContact : std::uint32_t {
    held = 0xfffffe00u /* the first of its octants */,
    guide_front = 0xfffffffcu,
    guide_rear = 0xfffffffdu,
    metal = 0xfffffffeu,
    region = 0xffffffffu
};
/// Returns a contact channel of the host along `d` [–, m]. `depth` [m] is the penetration, negative while the parts are
/// separated.   [any] pure, nonblocking.
[[nodiscard]] kerf_channel contact_channel(OwnContact what, const Vec6& d, double stiffness, double depth) noexcept;

[[nodiscard]] inline Vec6 direction(const kerf_channel& c) noexcept {
    return {c.d[0], c.d[1], c.d[2], c.d[3], c.d[4], c.d[5]};
}

}  // namespace kerf
