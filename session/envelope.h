// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// Identifiers of a session. Neither is ever hashed: the same run must have the same hash.
namespace kerf::session {

/// Returns a version 4 UUID from the system's random source: "f81d4fae-7dec-41d0-a765-00a0c91e6bf6".   [main]
[[nodiscard]] std::string random_uuid();

/// Returns the wall-clock time: "2024-05-17T09:30:00Z".   [main]
[[nodiscard]] std::string utc_now();

}  // namespace kerf::session
