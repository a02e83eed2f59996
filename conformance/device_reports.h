// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "kerf/device.h"

/// What is wrong with the values that a driver gives, as the cause of a failure; empty if nothing is. All pure.   [any]
namespace kerf::conformance {

/// Checks a text of a fixed size: it ends with NUL, and is plain UTF-8.
[[nodiscard]] std::string fault_of_text(const char* text, std::size_t size);
template <std::size_t size>
[[nodiscard]] std::string fault_of_text(const char (&text)[size]) {
    return fault_of_text(text, size);
}

/// Checks the id of a device: one character or more, of those that a station can name.
[[nodiscard]] std::string fault_of_id(std::string_view id);

/// Checks what a device states, as the host does, and that it states no limits of an ability that it lacks.
[[nodiscard]] std::string fault_of_statement(const kerf_device_facts& facts);

/// Checks a report of a device of these facts. What is not VALID only needs a sound age and known flags.
[[nodiscard]] std::string fault_of_report(const kerf_device_facts& facts, const kerf_device_state& state);

}  // namespace kerf::conformance
