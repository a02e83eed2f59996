// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

struct sqlite3;

namespace kerf::session {

/// Returns why SQLite failed, for people, if the reason lies outside of the file's contents: a full disk, a limit, a
/// lack of memory, a lock, a missing permission. No full stop at its end. Empty for damaged contents and for a
/// statement that does not fit them.   [any]
/// @param code  the result of the call that failed last on this connection
[[nodiscard]] std::string outside_reason(sqlite3* database, int code);

}  // namespace kerf::session
