// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "conformance/test_groups.h"

namespace kerf::conformance {

std::span<const Test> all_tests() {
    static const std::vector<Test> all = [] {
        std::vector<Test> tests;
        for (const auto group :
             {load_tests(), shape_tests(), law_tests(), repeat_tests(), memory_tests(), real_time_tests(),
              range_tests(), use_tests(), physics_tests(), physics_direction_tests(), physics_contact_tests(),
              physics_bone_tests(), physics_parameter_tests(), physics_set_tests(), physics_signal_tests(),
              strategy_tests(), device_tests()})
            tests.insert(tests.end(), group.begin(), group.end());
        return tests;
    }();
    return all;
}

}  // namespace kerf::conformance
