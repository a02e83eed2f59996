// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf {

/// Returns the fewest digits, at least `digits`, with which a value and its bound have different texts: 59.98 of
/// 60.00, not 60.0 of 60.0. Equal numbers, and those that `most` digits do not tell apart, have `digits`.   [any]
/// @param text_of   (number, digits) → its text
template <class TextOf>
[[nodiscard]] int telling_digits(double value, double bound, int digits, int most, const TextOf& text_of) {
    if (value == bound) return digits;
    for (int more = digits; more <= most; ++more)
        if (text_of(value, more) != text_of(bound, more)) return more;
    return digits;
}

}  // namespace kerf
