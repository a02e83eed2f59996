// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <span>
#include <string_view>

#include "devices/pedal/report.h"
#include "tests/fuzz/fuzz_target.h"

bool kerf::fuzz::reads(std::string_view input) {
    const auto buttons = pedal::decode({reinterpret_cast<const std::uint8_t*>(input.data()), input.size()});
    require(!buttons || *buttons < 1u << pedal::button_count, "it has three buttons");
    return buttons.has_value();
}
