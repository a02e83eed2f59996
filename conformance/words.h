// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "kerf/abi.h"

/// How messages name things.
namespace kerf::conformance {

/// A number as a message prints it.
[[nodiscard]] std::string number(double value);
/// "channel 2 (contact, id 7)"
[[nodiscard]] std::string name_of(const kerf_channel& channel, std::size_t index);
/// "returned -1 (KERF_FAILED), expected 0 (KERF_OK)"
[[nodiscard]] std::string name_of_status(kerf_status status);

}  // namespace kerf::conformance
