// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <string>

namespace kerf {

/// Returns a number with at most `digits` significant digits, 17 at most, as `printf("%.*g")` does in the C locale.
/// [any] pure.
[[nodiscard]] inline std::string number_text(double value, int digits) {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr};
}

}  // namespace kerf
