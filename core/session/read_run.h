// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/session/drawn_surface.h"
#include "core/session/recording.h"

namespace kerf {

/// What a session holds of a run: all that its page shows.
struct RecordedRun {
    RunSummary summary;  ///< of a run that was cut short: what is known of it, with the verdict incomplete and that as
                         ///< its reason
    std::vector<TickRow> ticks;
    std::vector<EventRow> events;
    DrawnSurface bone_after;  ///< empty for a run that was cut short
    std::string missing;      ///< what the session lacks, for people; empty for a whole one
};

/// Reads a session file without changing it or its folder. Error: not a session, another schema, rows that no run
/// writes; `error` is for people.   [main]
[[nodiscard]] std::optional<RecordedRun> read_run(const std::string& path, std::string& error);

}  // namespace kerf
