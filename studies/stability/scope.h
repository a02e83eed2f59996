// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "studies/stability/port.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// How much is looked at.
struct Scope {
    std::vector<DeviceRecord> devices;
    std::vector<TestHand> hands;
    int max_delay = max_latency;
    bool is_quick = false;
    Clock clock = Clock::in_time;

    /// Every device record, every hand, every delay; quick: one device, the bare one and the nominal hand, no delay
    /// and one tick. Records with a motor about the shaft are left out: their forces are those of another record.
    [[nodiscard]] static Scope of(bool is_quick);
};

/// Calls `look(device, port settings)` for every device × hand × delay.
template <class Look>
void at_every_port(const Scope& scope, const Look& look) {
    for (const DeviceRecord& device : scope.devices)
        for (const TestHand& hand : scope.hands)
            for (int delay = 0; delay <= scope.max_delay; ++delay) {
                PortSettings settings = port_of(device, hand, delay);
                settings.clock = scope.clock;
                look(device, settings);
            }
}

}  // namespace kerf::stability
