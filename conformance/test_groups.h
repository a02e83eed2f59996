// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "conformance/test.h"

/// The tests by what they examine, one file each.
namespace kerf::conformance {

[[nodiscard]] std::span<const Test> load_tests();               // level 1
[[nodiscard]] std::span<const Test> use_tests();                // level 3: the plugin as a whole, while it is used
[[nodiscard]] std::span<const Test> shape_tests();              // level 2
[[nodiscard]] std::span<const Test> law_tests();                // level 3: what a law answers
[[nodiscard]] std::span<const Test> repeat_tests();             // level 3: whether it answers the same again
[[nodiscard]] std::span<const Test> memory_tests();             // level 3: what it reads and writes
[[nodiscard]] std::span<const Test> real_time_tests();          // level 3: what it does between pose and force
[[nodiscard]] std::span<const Test> range_tests();              // level 3: over parameters, drives, bone, ticks
[[nodiscard]] std::span<const Test> physics_tests();            // level 4
[[nodiscard]] std::span<const Test> physics_direction_tests();  // level 4: running, in all directions
[[nodiscard]] std::span<const Test> physics_contact_tests();    // level 4: at rest, in all directions
[[nodiscard]] std::span<const Test> physics_bone_tests();       // level 4: bones, and the work that they cost
[[nodiscard]] std::span<const Test> physics_set_tests();        // level 4: random sets of parameters
[[nodiscard]] std::span<const Test> physics_parameter_tests();  // level 4: parameters, drives, feeds, ticks
[[nodiscard]] std::span<const Test> physics_signal_tests();     // level 4: signals against forces
[[nodiscard]] std::span<const Test> strategy_tests();           // levels 3 and 4: remeshing strategies

[[nodiscard]] std::span<const Test> device_tests();  // level 3: drivers of devices

}  // namespace kerf::conformance
