// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "session/recording.h"
#include "session/report/drawn_run.h"
#include "session/report/recorded_procedure.h"

namespace kerf::session {

/// All data of a run that its page shows, read from a session.
struct RecordedRun {
    RunSummary summary;           ///< for a run that was cut short: its known data, verdict incomplete
    DrawnRun drawn;               ///< without bone for a run that was cut short
    RecordedProcedure procedure;  ///< the readable part of its text
    std::string missing;          ///< the missing part of the session, for people; empty if complete
    bool is_bone_placed = false;  ///< the middle of the drawn bone is known; false in sessions of older schemas
    bool has_result = false;      ///< false: the run was cut short
};

/// Gets each row of a session while it is read: first all events, then all ticks.
class RowObserver {
public:
    virtual ~RowObserver() = default;
    /// Gets the data from before the first tick: the procedure, its tissues and the scale of the force.
    virtual void on_begin(const RecordedRun& run) = 0;
    virtual void on_event(const EventRow& event) = 0;
    /// Ticks rise. Numbers may be NaN or infinite. Not read are the torques of `modelled`, `coupled`, `limited`, the
    /// powers and the iterations.
    virtual void on_tick(const TickRow& row) = 0;
};

/// Reads a session file without changing it or its folder, one row at a time. Error: not a session, another schema,
/// rows that no run writes, or rows that do not match the checksum; `error` is a text for people.
/// @param is_own   the run that wrote the file reads it, and still has its folder locked   [main]
/// @param observer  gets the rows; null: none does
[[nodiscard]] std::optional<RecordedRun> read_run(const std::string& path, std::string& error, bool is_own = false,
                                                  RowObserver* observer = nullptr);

}  // namespace kerf::session
