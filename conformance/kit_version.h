// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf::conformance {

/// Number of the kit's list of tests. It rises when a test is added, removed or moved to another level; the test
/// `KitVersion.RisesWithTheTests` compares it with the list.
inline constexpr int kit_version = 3;

}  // namespace kerf::conformance
