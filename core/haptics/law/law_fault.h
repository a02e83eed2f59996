// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "kerf/abi.h"

namespace kerf {

/// The reason why the host closed the force gate: the faulty value and its law. It owns no memory, so the tick can
/// store it.
struct LawFault {
    enum class What : std::uint8_t {
        none,
        status,
        count,
        channel,
        wrench,
        solve,
        floating_point,
        commit_status,
        signal,
        underrun,
        impure
    };
    What what = What::none;
    const kerf_component* law = nullptr;
    std::uint32_t index = 0;    ///< of the channel, of the wrench's component, or of the signal
    std::uint32_t id = 0;       ///< of the channel
    const char* field = "";     ///< name of the channel's faulty field, or of the array; a literal
    const char* expected = "";  ///< range of that field; a literal
    double value = 0.0;         ///< faulty value; for `solve` the residual
};

/// Returns the message for a fault, empty for `What::none`. Example: "`burring` of stranger.burr: channel 0 (id 7):
/// `delta` is nan, expected a finite number."   [main] while the law's plugin is loaded
[[nodiscard]] std::string text_of(const LawFault& fault);

/// Returns the name of a law with its plugin, such as "`burring` of stranger.burr". Returns the law's id alone if no
/// loaded plugin has it.   [main]
[[nodiscard]] std::string name_of_law(const kerf_component& law);

}  // namespace kerf
