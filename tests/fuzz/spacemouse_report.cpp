// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>

#include "devices/spacemouse/deflections.h"
#include "devices/spacemouse/report.h"
#include "tests/fuzz/fuzz_target.h"

bool kerf::fuzz::reads(std::string_view input) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    const auto report = spacemouse::decode(bytes);
    spacemouse::Deflections cap;
    kerf_device_state state{};
    require(cap.take(bytes, 0.0, state) == report.has_value(), "a report is taken if it can be read");
    for (const double d : state.deflection) require(std::abs(d) <= 1.0, "a deflection is a fraction of the range");
    require(!cap.expire(0.1, state), "a deflection lasts 100 ms");
    static_cast<void>(cap.expire(0.2, state));
    for (const double d : state.deflection) require(d == 0.0, "an old deflection is zero");
    return report.has_value();
}
