// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace kerf::session {

/// Returns the versions of a session's parts, as SessionHeader::versions: "kerf", its plugins, and "ID SHA-256" of the
/// file of a plugin that is not shipped. Empty if the session cannot be read.   [main]
[[nodiscard]] std::map<std::string, std::string> recorded_versions(const std::string& path);

}  // namespace kerf::session
