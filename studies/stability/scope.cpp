// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/scope.h"

namespace kerf::stability {

Scope Scope::of(bool is_quick) {
    Scope scope;
    scope.is_quick = is_quick;
    int count = 0;
    const DeviceRecord* all = all_devices(count);
    if (is_quick) {
        scope.devices = {*find_device("premium-1.5-6dof")};
        scope.hands = {no_hand, test_hands[2]};
        scope.most_delay = 1;
    } else {
        scope.devices.assign(all, all + count);
        scope.hands.assign(test_hands.begin(), test_hands.end());
    }
    return scope;
}

}  // namespace kerf::stability
