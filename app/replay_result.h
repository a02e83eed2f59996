// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/exit_code.h"
#include "core/plugin/loader.h"
#include "documents/procedure.h"
#include "session/read_session.h"

namespace kerf::app {

/// A replay that has ended, with its recording.
struct EndedReplay {
    const session::RecordedInputs& recorded;
    const std::string& recorded_file;  ///< the session of the recording
    const session::RunSummary& replayed;
    const std::string& replayed_file;  ///< the session of the replay
    const documents::Procedure& procedure;
    const PluginRegistry& plugins;
};

/// Prints whether a replay ended as its recording did, and whether the recording is unchanged. If the bits differ,
/// prints which plugin has another file, the tick of the first difference, and the law in hand there.   [main]
[[nodiscard]] ExitCode compare(const EndedReplay& replay);

}  // namespace kerf::app
