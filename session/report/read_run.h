// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "session/recording.h"
#include "session/report/drawn_run.h"
#include "session/report/recorded_procedure.h"

namespace kerf {

/// What a session holds of a run: all that its page shows.
struct RecordedRun {
    RunSummary summary;  ///< of a run that was cut short: what is known of it, with the verdict incomplete and that as
                         ///< its reason
    DrawnRun drawn;      ///< without bone for a run that was cut short
    RecordedProcedure procedure;  ///< as far as its text could be read
    std::string missing;          ///< what the session lacks, for people; empty for a whole one
};

/// Reads a session file without changing it or its folder, one row at a time. Error: not a session, another schema,
/// rows that no run writes, rows that are not those of the session's checksum; `error` is for people.
/// @param is_own   the run that wrote it reads it, and still holds its folder   [main]
[[nodiscard]] std::optional<RecordedRun> read_run(const std::string& path, std::string& error, bool is_own = false);

}  // namespace kerf
