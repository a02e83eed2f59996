// SPDX-License-Identifier: Apache-2.0
#include "run/arm_views.h"

#include "text/quantity.h"

namespace kerf::run {

namespace {

/// Returns an angle in degrees, rounded to a tenth.
std::string in_degrees(double angle) {
    constexpr double degree = std::numbers::pi / 180.0;
    return text::quantity_text(0.1 * std::round(10.0 * angle / degree) * degree, "deg");
}

}  // namespace

std::string arm_words(double about_head_axis, double tilt) {
    constexpr double same = 1e-6;  // [rad]
    for (const ArmView& view : arm_views)
        if (std::abs(about_head_axis - view.about_head_axis) < same && std::abs(tilt - view.tilt) < same)
            return view.words;
    return in_degrees(about_head_axis) + (std::abs(tilt) < same ? "" : ", tilted " + in_degrees(tilt));
}

}  // namespace kerf::run
