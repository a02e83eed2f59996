// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "kerf/abi.h"

namespace kerf {

/// The reason why the host released the force: the faulty value and its law. Plain values, so that the tick can store
/// it.
struct LawFault {
    enum class What : std::uint8_t { none, status, count, channel, wrench, solve };
    What what = What::none;
    const kerf_component* law = nullptr;
    std::uint32_t index = 0;    ///< of the channel, or of the wrench's component
    std::uint32_t id = 0;       ///< of the channel
    const char* field = "";     ///< of the channel; a literal
    const char* expected = "";  ///< of that field; a literal
    double value = 0.0;
};

/// Returns the message for a fault, empty for none. "`burring` of stranger.burr: channel 0 (id 7): `delta` is nan,
/// expected a finite number."   [main] while its plugin is loaded
[[nodiscard]] std::string text_of(const LawFault& fault);

/// Returns the name of a law, "`burring` of stranger.burr", or the component's id alone if no loaded plugin has it.
/// [main]
[[nodiscard]] std::string name_of_law(const kerf_component& law);

}  // namespace kerf
