// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/scope.h"

#include <algorithm>
#include <iterator>

namespace kerf::stability {

Scope Scope::of(bool is_quick) {
    Scope scope;
    scope.is_quick = is_quick;
    if (is_quick) {
        scope.devices = {*find_device("premium-1.5-6dof")};
        scope.hands = {no_hand, test_hands[2]};
        scope.max_delay = 1;
    } else {
        // What a motor about the shaft adds is tested by tests/core/haptics/torque_axis_test.cpp.
        const std::span<const DeviceRecord> all = all_devices();
        std::copy_if(all.begin(), all.end(), std::back_inserter(scope.devices),
                     [](const DeviceRecord& device) { return device.axis.peak_torque == 0.0; });
        scope.hands.assign(test_hands.begin(), test_hands.end());
    }
    return scope;
}

}  // namespace kerf::stability
