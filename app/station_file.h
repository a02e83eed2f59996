// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/station.h"
#include "text/result.h"

/// The file with the setup of the devices of this table.
namespace kerf::app {

/// Returns its path: $KERF_STATION, or kerf/station.yaml in the user's configuration folder. Empty if there is no such
/// folder.   [main]
[[nodiscard]] std::string station_file();

/// Reads it. A file that does not exist gives a station without devices. Error: all that is wrong.   [main]
[[nodiscard]] text::Result<documents::Station> read_own_station();

/// Writes a station with the defaults of a device, to be changed. Returns the error; empty on success. Never writes
/// over a file that exists.   [main]
[[nodiscard]] std::string write_station(const std::string& file, const std::string& device);

}  // namespace kerf::app
