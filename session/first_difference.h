// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace kerf::session {

/// The first tick in which two sessions differ.
struct FirstDifference {
    std::uint64_t tick = 0;
    double time = 0.0;  ///< [s]
    int step = -1;      ///< of the tick, in the first session; −1: none
    std::string what;   ///< "the wrench of the bone"; "the event `bone.crumbled`"; for people
};

/// Compares the hashed values of two sessions tick by tick, as they are recorded: poses and wrenches as 32-bit floats.
/// Returns nothing if the recorded values are equal; then `error` is empty unless a session cannot be read.   [main]
[[nodiscard]] std::optional<FirstDifference> first_difference(const std::string& recorded, const std::string& replayed,
                                                              std::string& error);

}  // namespace kerf::session
