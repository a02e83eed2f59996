// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::text {

/// Returns the smallest number of digits, at least `digits`, that makes the texts of a value and its bound differ:
/// 59.98 and 60.00, not 60.0 and 60.0. Returns `digits` for equal numbers, and for numbers whose texts agree up to
/// `most` digits.   [any]
/// @param text_of   (number, digits) → text of the number
template <class TextOf>
[[nodiscard]] int distinguishing_digits(double value, double bound, int digits, int most, const TextOf& text_of) {
    if (value == bound) return digits;
    for (int more = digits; more <= most; ++more)
        if (text_of(value, more) != text_of(bound, more)) return more;
    return digits;
}

/// A value and its bound as a message shows them: with the digits that make them differ.
struct ComparedTexts {
    std::string value, bound;
};

/// Returns the texts of a value and its bound, as distinguishing_digits().   [any]
template <class TextOf>
[[nodiscard]] ComparedTexts compared(double value, double bound, int digits, int most, const TextOf& text_of) {
    const int enough = distinguishing_digits(value, bound, digits, most, text_of);
    return {text_of(value, enough), text_of(bound, enough)};
}

}  // namespace kerf::text
