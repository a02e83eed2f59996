// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf::run {

/// What the buttons of a device request in a tick.
struct ButtonPresses {
    bool is_driving = true;   ///< the tool's motor runs: a button is held, or the device has none for it
    bool wants_next = false;  ///< the next action of the step
    bool wants_undo = false;
};

}  // namespace kerf::run
