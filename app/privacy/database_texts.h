// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/privacy/privacy_report.h"

namespace kerf::app::privacy {

/// Returns the texts of all tables of an SQLite database, each with a line end; numbers are left out, for they resemble
/// anything. Bytes are searched here.   [main]
/// @param report  its `error` is set if the database cannot be opened
/// @param fault   set to the reason why the database could not be read to its end, for people; empty if it could
[[nodiscard]] std::string texts_of_database(const std::string& file, std::string& fault, PrivacyReport& report);

}  // namespace kerf::app::privacy
