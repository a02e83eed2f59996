// SPDX-License-Identifier: Apache-2.0
#pragma once

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf {

/// The larger of two; no number where either is none, so that a force that is no number passes no test.   [any] pure.
[[nodiscard]] constexpr double worst(double a, double b) noexcept { return a != a || a > b ? a : b; }

}  // namespace kerf
