// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kerf/device_driver.hpp"

namespace kerf::replay {

/// A handle that plays a motion, whatever the force. The station names the motion's file as `motion`.
///
/// The motion begins with the first command of a tick. Read number k after it gets the pose of k milliseconds.
struct Replay {
    static constexpr auto about() {
        return describe("replay", "A handle that plays a motion: the file `motion` of the station.");
    }
    /// Returns nothing: only the station knows the motion.
    [[nodiscard]] std::vector<DeviceFound> find() const { return {}; }
    /// Throws std::runtime_error with the reason if there is no motion.
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::replay
