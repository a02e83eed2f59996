// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// What tells one session from another. Neither is ever hashed: the same run must end in the same hash.
namespace kerf {

/// A version 4 UUID out of the system's randomness: "f81d4fae-7dec-41d0-a765-00a0c91e6bf6".   [main]
[[nodiscard]] std::string random_uuid();

/// The wall clock: "2024-05-17T09:30:00Z".   [main]
[[nodiscard]] std::string utc_now();

}  // namespace kerf
