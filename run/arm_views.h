// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>

/// Where a C-arm is when it takes an image. Angles as in bone/radiograph/beam.h [rad].
namespace kerf::run {

struct ArmView {
    const char* words;
    double about_head_axis, tilt;
};
/// The views between which a viewer turns the arm, in this order.
inline constexpr std::array<ArmView, 3> arm_views{
    {{"AP", 0.0, 0.0}, {"lateral", 0.5 * std::numbers::pi, 0.0}, {"oblique 30 deg", std::numbers::pi / 6.0, 0.0}}};

/// Returns whether a C-arm can have an angle: within one turn in either direction.   [any] pure.
[[nodiscard]] inline bool is_arm_angle(double angle) noexcept { return std::abs(angle) <= 2.0 * std::numbers::pi; }

/// Returns a view in words: "AP", or its angles, "20 deg, tilted 10 deg".   [any] pure.
[[nodiscard]] std::string arm_words(double about_head_axis, double tilt);

}  // namespace kerf::run
