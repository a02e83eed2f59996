// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// Texts of the panels.
namespace kerf::window {

/// `printf` into a string of at most 255 bytes.   [any]
[[gnu::format(printf, 1, 2)]] [[nodiscard]] std::string formatted(const char* form, ...);

/// Returns "01:05" for 65 s.   [any] pure
[[nodiscard]] std::string clock_text(double seconds);

}  // namespace kerf::window
