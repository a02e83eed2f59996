// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

struct sqlite3;

namespace kerf {

/// The key in table `session` of the checksum that a run writes at its end.
inline constexpr const char* record_checksum_key = "record_checksum";

/// Returns a checksum of all that a session's tables hold: 64-bit FNV-1a over the statement that made each table, and
/// over type and value of every row, in order, but for the checksum's own. Rows go by one at a time, so memory does not
/// grow with the run. Nothing if a table cannot be read.
///
/// It finds damage and simple edits. It does not find a forger, who can compute it anew.   [main, worker]
[[nodiscard]] std::optional<std::uint64_t> record_checksum(sqlite3* database);

/// How a session's rows compare with its checksum.
enum class RecordCheck {
    same,     ///< they are those that the run wrote
    changed,  ///< they are not, or the checksum was removed
    unknown,  ///< there is none: the run was killed, or an older Kerf wrote it
};

/// Compares. Pre: an opened session, whose tables compute nothing.   [main]
[[nodiscard]] RecordCheck check_record(sqlite3* database);

}  // namespace kerf
