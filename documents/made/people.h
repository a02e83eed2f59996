// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/made/request.h"

namespace kerf::documents {

/// Returns 1 for men, −1 for women, and 0 if the sex is unsaid: the factor of a difference between the sexes.   [any]
[[nodiscard]] constexpr double sign_of(MakeRequest::Sex sex) noexcept {
    return sex == MakeRequest::Sex::male ? 1.0 : sex == MakeRequest::Sex::female ? -1.0 : 0.0;
}

/// How tall people are [m].
struct Stature {
    double mean = 0.0, sd = 0.0;
};

/// Returns the stature of adults of one sex: men 176 ± 7 cm, women 163 ± 6.5 cm (recalled).   [any]
[[nodiscard]] constexpr Stature stature_of(MakeRequest::Sex sex) noexcept {
    return {1.695 + 0.065 * sign_of(sex), 0.0675 + 0.0025 * sign_of(sex)};
}

}  // namespace kerf::documents
