// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace kerf::run {

/// Paces the ticks of a run: the wall clock, the clock of a device, or a virtual one in tests.
class TickClock {
public:
    virtual ~TickClock() = default;

    /// Waits until the next tick is due. Returns the number of periods that passed without a tick since the last one.
    /// [haptic] it may sleep
    [[nodiscard]] virtual std::uint32_t wait() noexcept = 0;
    /// Marks the time when all of a tick is done.   [haptic, nonblocking]
    virtual void tick_done() noexcept {}
};

}  // namespace kerf::run
