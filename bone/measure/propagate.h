// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bone/measure/measured.h"

namespace kerf::bone {

/// Returns the standard uncertainty of a coordinate that lies within ± `tolerance` [m] with equal probability:
/// tolerance / √3.   [any] pure.
///
/// Source: [gum-2008], 4.3.7.
[[nodiscard]] inline double standard_uncertainty_of(double tolerance) noexcept { return tolerance / std::sqrt(3.0); }

/// A value and its operands: the quantities that it is computed from last, such as an angle and the components of two
/// directions.
struct TracedValue {
    double value = 0.0;
    std::vector<double> operands{};
};

/// Returns a value and its uncertainty from independent inputs, to the first order by finite differences:
///
///     u²(f) = Σ ((f(x_i + u_i) − f(x_i − u_i)) / 2)²
///
/// with u_i the standard uncertainty of input i, in its own unit. If the value exists on one side of an input only,
/// that side counts in full.
///
/// At a fold the derivative is zero, but the value spreads: an angle or a distance of 0 only becomes larger. There the
/// last function f is evaluated for drawn operands:
///
///     u²(f) = mean of (f(y + Σ z_i c_i) − f(y))²
///
/// with y the operands, c_i half their change between x_i − u_i and x_i + u_i, and z_i even between ±√3 [–]. So u is
/// the root mean square about the value, not about the mean. It counts where it differs from the first order by more
/// than 5 %, on the same draws, and at least half of the draws have a value. The draws are fixed, each with its
/// opposite. Leaves out folds before the operands.
///
/// Nothing if the value does not exist at the inputs themselves, or on neither side of one.
/// @param uncertainties  #N of the inputs, each ≥ 0
/// @param traced_at      #N shifts of the inputs → the value and its #M operands, or nothing
/// @param value_of       #M operands → the value, or nothing
/// @param pairs          number of draws, without their opposites
///
/// Source: [gum-2008], 5.1.2 and 5.1.3, note 2, for the first order; the draws are ours.   [any] pure if the functions
/// are.
[[nodiscard]] std::optional<Measured> propagate(
    std::span<const double> uncertainties,
    const std::function<std::optional<TracedValue>(std::span<const double>)>& traced_at,
    const std::function<std::optional<double>(std::span<const double>)>& value_of, std::size_t pairs = 512);

}  // namespace kerf::bone
