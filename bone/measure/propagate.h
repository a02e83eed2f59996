// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
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

/// Returns a value and its uncertainty from independent inputs, by finite differences.
///
///     u²(y) = Σ ((f(x_i + u_i) − f(x_i − u_i)) / 2)²
///
/// with u_i the standard uncertainty of input i, in its own unit. If the value exists on one side of an input only,
/// that side counts in full. Nothing if it does not exist at the inputs themselves, or on neither side of one.
/// @param uncertainties  #N of the inputs, each ≥ 0
/// @param value_at       #N shifts of the inputs → the value, or nothing
///
/// Source: [gum-2008], 5.1.2 and 5.1.3, note 2. Leaves out terms of higher order.   [any] pure if `value_at` is.
template <class ValueAt>
[[nodiscard]] std::optional<Measured> propagate(std::span<const double> uncertainties, ValueAt&& value_at) {
    std::vector<double> shifts(uncertainties.size(), 0.0);
    const auto shifted = [&](std::size_t input, double by) -> std::optional<double> {
        shifts[input] = by;
        const std::optional<double> value = value_at(std::span<const double>(shifts));
        shifts[input] = 0.0;
        return value;
    };
    const std::optional<double> value = value_at(std::span<const double>(shifts));
    if (!value) return std::nullopt;
    double squares = 0.0;
    for (std::size_t i = 0; i < uncertainties.size(); ++i) {
        if (!(uncertainties[i] > 0.0)) continue;
        const auto above = shifted(i, uncertainties[i]), below = shifted(i, -uncertainties[i]);
        if (!above && !below) return std::nullopt;
        const double change = above && below ? 0.5 * (*above - *below) : *(above ? above : below) - *value;
        squares += change * change;
    }
    return Measured{*value, std::sqrt(squares)};
}

}  // namespace kerf::bone
