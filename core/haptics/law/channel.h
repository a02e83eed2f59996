// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/math.hpp"

/// One monotone scalar channel of a law: its force, its slope, whether it is sound.
namespace kerf {

/// Force and slope of a channel at rate `s`.
struct ChannelForce {
    double lambda = 0.0;  ///< [N]
    double slope = 0.0;   ///< [N·s/m] ≥ 0
};

/// λ(s) of a channel as the ABI states it, `dt` the tick [s]. Non-decreasing in s.   [any] pure, nonblocking.
///
/// Source: docs/design/tick.md, "The solve".
[[nodiscard]] ChannelForce channel_force(const kerf_channel& channel, double s, double dt) noexcept;

/// The first field with which the host may not solve, as literals; null where there is none.
struct ChannelFault {
    const char* field = nullptr;
    const char* expected = "";
    double value = 0.0;
};
[[nodiscard]] ChannelFault fault_of(const kerf_channel& channel) noexcept;  // [any] pure, nonblocking

/// Whether the host may solve with it: finite, a direction, nothing that would push.   [any] pure, nonblocking.
[[nodiscard]] inline bool is_sound(const kerf_channel& channel) noexcept { return fault_of(channel).field == nullptr; }

/// The host's own contact, beside the plugin's: along `d` [–, m], pressed in by `depth` [m], negative while it is
/// apart. Its id says what touches.   [any] pure, nonblocking.
enum class OwnContact : std::uint32_t {
    held = 0xfffffe00u /* the first of its octants */,
    guide_front = 0xfffffffcu,
    guide_rear = 0xfffffffdu,
    metal = 0xfffffffeu,
    region = 0xffffffffu
};
[[nodiscard]] kerf_channel contact_channel(OwnContact what, const Vec6& d, double stiffness, double depth) noexcept;

[[nodiscard]] inline Vec6 direction(const kerf_channel& c) noexcept {
    return {c.d[0], c.d[1], c.d[2], c.d[3], c.d[4], c.d[5]};
}

}  // namespace kerf
