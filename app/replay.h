// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/haptics/loop/stated_device.h"
#include "documents/procedure.h"
#include "run/run_procedure.h"
#include "session/read_session.h"

/// Feeds a recorded session to a run.
namespace kerf::app {

/// Returns why a session cannot be repeated with this procedure, for people; empty if it can.   [any] pure.
[[nodiscard]] std::string refusal_of_replay(const session::RecordedInputs& recorded, const std::string& session,
                                            const documents::Procedure& procedure);

/// Returns the message for a session that was recorded with other documents.   [any] pure.
[[nodiscard]] std::string refusal_of_other_text(const std::string& session);

/// Returns why a session whose rows do not give its checksum cannot be used, for people; empty if they do, or if it has
/// none.   [any] pure.
[[nodiscard]] std::string refusal_of_changed(const session::RecordedInputs& recorded, const std::string& session);

/// Copies the inputs of a session to a request. Returns why a run cannot repeat them, for people; empty if it can.
/// [any]
[[nodiscard]] std::string repeat(const session::RecordedInputs& recorded, const std::string& session,
                                 run::RunRequest& request);

/// Makes the device that a session was recorded with; `device` stays null if it had none. Returns why it cannot, for
/// people; empty if it can.   [any]
[[nodiscard]] std::string recorded_device(const session::RecordedInputs& recorded, const std::string& session,
                                          std::unique_ptr<StatedDevice>& device);

}  // namespace kerf::app
