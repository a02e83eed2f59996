// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "conformance/law_probe.h"

namespace kerf::conformance {

/// What a law makes with one set of parameters [N]: fed, moved across, pressed on at rest. Negative where it does not
/// cut, as with a motor that is too weak.
using Sizes = std::array<double, 3>;
inline constexpr const char* name_of_size[] = {"fed in solid bone", "moved along +x in solid bone",
                                               "pressed 0.1 mm into bone at rest"};

/// A continuous path through the parameters of a tool and its law.
struct Sweep {
    const Subject& subject;
    std::function<WalkSettings(double)> settings;  ///< of a point of the path, in bone without end
    std::function<std::string(double)> named;      ///< that point, for a message
};

/// Returns whether the tool can be made there; then writes the sizes.   [main]
bool sizes_at(const Sweep& sweep, double value, Sizes& sizes);

/// The first jump of a force along increasing points of the path, in a sentence; empty without one.   [main]
[[nodiscard]] std::string jump_along(const Sweep& sweep, const std::vector<double>& points);

}  // namespace kerf::conformance
