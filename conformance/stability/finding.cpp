// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/stability/finding.h"

#include <charconv>
#include <cmath>

namespace kerf::stability {

std::string figure(double value, const char* unit) {
    char text[32];
    // Tidy: what is less than any figure here is nothing, and has no sign.
    const auto end =
        std::to_chars(text, text + sizeof text, std::abs(value) < 1e-12 ? 0.0 : value, std::chars_format::general, 3);
    return std::string(text, end.ptr) + (*unit != '\0' ? std::string(" ") + unit : "");
}

}  // namespace kerf::stability
