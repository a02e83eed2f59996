// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/propagate.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <utility>

namespace kerf::bone {
namespace {

using TracedAt = std::function<std::optional<TracedValue>(std::span<const double>)>;
using ValueOf = std::function<std::optional<double>(std::span<const double>)>;

/// The changes for one standard uncertainty of one input.
struct Change {
    double value = 0.0;
    std::vector<double> operands;
};

/// A value, its operands, and their changes for each input with an uncertainty.
struct Linearised {
    TracedValue at{};
    std::vector<Change> changes{};
    [[nodiscard]] double uncertainty() const noexcept {
        double squares = 0.0;
        for (const Change& change : changes) squares += change.value * change.value;
        return std::sqrt(squares);
    }
};

/// Returns half the change from `below` to `above`; all of the change from `at` if only one of both exists.
Change change_between(const TracedValue& at, const std::optional<TracedValue>& above,
                      const std::optional<TracedValue>& below) {
    const auto change = [&](double value, double of_above, double of_below) {
        return above && below ? 0.5 * (of_above - of_below) : (above ? of_above : of_below) - value;
    };
    const TracedValue &high = above ? *above : at, &low = below ? *below : at;
    Change found{change(at.value, high.value, low.value), {}};
    for (std::size_t m = 0; m < at.operands.size(); ++m)
        found.operands.push_back(change(at.operands[m], high.operands[m], low.operands[m]));
    return found;
}

std::optional<Linearised> linearise(std::span<const double> uncertainties, const TracedAt& traced_at) {
    std::vector<double> shifts(uncertainties.size(), 0.0);
    const auto shifted = [&](std::size_t input, double by) {
        shifts[input] = by;
        std::optional<TracedValue> traced = traced_at(shifts);
        shifts[input] = 0.0;
        return traced;
    };
    std::optional<TracedValue> at = traced_at(shifts);
    if (!at) return std::nullopt;
    Linearised found{std::move(*at), {}};
    for (std::size_t i = 0; i < uncertainties.size(); ++i) {
        if (!(uncertainties[i] > 0.0)) continue;
        const auto above = shifted(i, uncertainties[i]), below = shifted(i, -uncertainties[i]);
        if (!above && !below) return std::nullopt;
        found.changes.push_back(change_between(found.at, above, below));
    }
    return found;
}

/// Draws shifts of inputs with mean 0 and variance 1, even between ±√3. The standard fixes the bits of the generator.
class Draws {
public:
    double next() noexcept {
        constexpr double per_step = 0x1p-52;
        const double even = static_cast<double>(generator_() >> 11U) * per_step - 1.0;  // −1 … 1
        return std::sqrt(3.0) * even;
    }

private:
    std::mt19937_64 generator_{0x6b657266};  // any number: the same bits in each run
};

}  // namespace

std::optional<Measured> propagate(std::span<const double> uncertainties, const TracedAt& traced_at,
                                  const ValueOf& value_of, std::size_t pairs) {
    const auto linear = linearise(uncertainties, traced_at);
    if (!linear) return std::nullopt;
    const TracedValue& at = linear->at;
    const Measured first_order{at.value, linear->uncertainty()};

    Draws draws;
    double squares = 0.0, linear_squares = 0.0;
    std::size_t found = 0;
    std::vector<double> change(at.operands.size()), operands(at.operands.size());
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        double linear_change = 0.0;
        change.assign(change.size(), 0.0);
        for (const Change& one : linear->changes) {
            const double z = draws.next();
            linear_change += z * one.value;
            for (std::size_t m = 0; m < change.size(); ++m) change[m] += z * one.operands[m];
        }
        for (const double sign : {1.0, -1.0}) {
            for (std::size_t m = 0; m < change.size(); ++m) operands[m] = at.operands[m] + sign * change[m];
            const auto value = value_of(operands);
            if (!value) continue;
            ++found;
            squares += (*value - at.value) * (*value - at.value);
            linear_squares += linear_change * linear_change;
        }
    }
    if (found <= pairs) return first_order;
    // On the same draws, so that both agree without noise where the value is linear.
    constexpr double close = 0.05;
    const double linear_spread = std::sqrt(linear_squares);
    if (std::abs(std::sqrt(squares) - linear_spread) <= close * linear_spread) return first_order;
    return Measured{at.value, std::sqrt(squares / static_cast<double>(found))};
}

}  // namespace kerf::bone
