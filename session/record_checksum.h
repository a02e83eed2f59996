// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "session/session_file.h"

namespace kerf::session {

/// The key of the checksum in table `session`, which a run writes at its end.
inline constexpr const char* record_checksum_key = "record_checksum";

/// Returns a checksum of all tables of a session, or nothing if a table cannot be read. It is the 64-bit FNV-1a of the
/// statement that made each table, and of type and value of every row in order, without the checksum's own row. Reads
/// one row at a time, so memory does not grow with the run.
///
/// It detects damage and simple edits. It does not detect a forger, who can recompute it.   [main, worker]
[[nodiscard]] std::optional<std::uint64_t> record_checksum(const SessionHandle& database);

/// Result of comparing a session's rows with its checksum.
enum class RecordCheck {
    same,     ///< the rows are as the run wrote them
    changed,  ///< the rows differ, or there is a result without a checksum
    unknown,  ///< no checksum: the run was killed, or an older Kerf wrote it
};

/// Compares the rows with the checksum. Pre: the session is open and its tables compute nothing.   [main]
[[nodiscard]] RecordCheck check_record(const SessionHandle& database);

}  // namespace kerf::session
