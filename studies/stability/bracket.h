// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// Between which two values a thing ceases to hold.
struct Bracket {
    double holds, fails;

    [[nodiscard]] double middle() const noexcept { return std::sqrt(holds * fails); }

    /// Narrows it by bisection, until they are no more than `ratio` apart. Pre: 0 < holds < fails.
    template <class Holds>
    [[nodiscard]] Bracket narrowed(double ratio, const Holds& does_hold) const {
        Bracket now = *this;
        while (now.fails / now.holds > ratio) {
            const double middle = now.middle();
            (does_hold(middle) ? now.holds : now.fails) = middle;
        }
        return now;
    }
};

}  // namespace kerf::stability
