// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/commands.h"
#include "app/exit_code.h"
#include "app/options.h"
#include "run/documents.h"
#include "run/scene.h"
#include "session/read_session.h"

/// The documents that a session was recorded with.
namespace kerf::app {

struct RecordedDocuments {
    session::RecordedInputs recorded;
    std::optional<run::Documents> documents;
    std::string file;  ///< of the procedure
};

/// Reads a session and its documents; without a named procedure, the shipped one with its text. Prints why they do not
/// fit together.   [main]
[[nodiscard]] ExitCode read_documents_of(const SessionOptions& options, const Environment& with,
                                         RecordedDocuments& result);

/// Makes their scene, and takes the documents. Prints the findings; returns nothing if there is an error, or if the
/// anatomy is another one.   [main]
/// @param session  file, for people
[[nodiscard]] std::optional<run::Scene> scene_of(RecordedDocuments& of_session, const std::string& session);

}  // namespace kerf::app
