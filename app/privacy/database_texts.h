// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/privacy/privacy_report.h"

namespace kerf::app::privacy {

/// Returns the texts of all tables of an SQLite database, each with a line end; numbers are left out, for they resemble
/// anything. Bytes are searched here.   [main]
/// @param is_whole   set to whether the whole database could be read
[[nodiscard]] std::string texts_of_database(const std::string& file, bool& is_whole, PrivacyReport& report);

}  // namespace kerf::app::privacy
