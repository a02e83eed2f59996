// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/station.h"
#include "text/result.h"

/// `kind: Station` from YAML to checked values.
namespace kerf::documents {

/// Reads and checks a station. Error: all that is wrong. Never throws.   [main]
[[nodiscard]] text::Result<Station> read_station(const std::string& file);

/// Reads a station from text in memory. `file` is only its name in messages.   [main]
[[nodiscard]] text::Result<Station> read_station_text(const std::string& file, std::string text);

}  // namespace kerf::documents
