// SPDX-License-Identifier: Apache-2.0
#include "app/window/window_text.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

namespace kerf::window {

std::string formatted(const char* form, ...) {
    std::array<char, 256> text{};
    va_list values;
    va_start(values, form);
    std::vsnprintf(text.data(), text.size(), form, values);
    va_end(values);
    return text.data();
}

std::string clock_text(double seconds) {
    constexpr double longest = 359'999.0;  // 5999 minutes and 59 seconds
    const int all = static_cast<int>(std::clamp(seconds, 0.0, longest));
    return formatted("%02d:%02d", all / 60, all % 60);
}

}  // namespace kerf::window
