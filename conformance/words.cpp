// SPDX-License-Identifier: Apache-2.0
#include "conformance/words.h"

#include <cstdio>

#include "text/plain_numbers.h"

namespace kerf::conformance {

std::string number(double value) {
    const text::PlainNumbers point;
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string name_of(const kerf_channel& channel, std::size_t index) {
    constexpr const char* kinds[] = {"cut", "contact", "friction", "hold"};
    return "channel " + std::to_string(index) + " (" + (channel.kind <= KERF_HOLD ? kinds[channel.kind] : "?") +
           ", id " + std::to_string(channel.id) + ")";
}

std::string name_of_status(kerf_status status) {
    const char* name = status == KERF_FAILED         ? " (KERF_FAILED)"
                       : status == KERF_OUT_OF_RANGE ? " (KERF_OUT_OF_RANGE)"
                       : status == KERF_CAPACITY     ? " (KERF_CAPACITY)"
                                                     : "";
    return "returned " + std::to_string(status) + name + ", expected 0 (KERF_OK)";
}

}  // namespace kerf::conformance
