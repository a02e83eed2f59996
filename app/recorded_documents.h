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
#include "text/source.h"

/// The documents that a session was recorded with.
namespace kerf::app {

struct RecordedDocuments {
    session::RecordedInputs recorded;
    std::optional<run::Documents> documents;
    std::string file;  ///< of the procedure
};

/// Why a session and its documents do not fit together.
struct DocumentRefusal {
    std::string clause{};          ///< for people, within a sentence: "no procedure has its text"
    std::string error{};           ///< the whole message about the session; empty: `findings` has it
    text::Diagnostics findings{};  ///< about a document
};

/// Prints why documents cannot be used. Returns exit_bad_input.   [main]
ExitCode complain(const DocumentRefusal& refusal);

/// Reads a session and its documents; without a named procedure, the shipped one with its text. Returns nothing if they
/// fit together.   [main]
[[nodiscard]] std::optional<DocumentRefusal> read_documents_of(const SessionOptions& options, const Environment& with,
                                                               RecordedDocuments& result);

/// Makes their scene, and takes the documents. Prints warnings. Returns nothing, and the reason in `refusal`, if there
/// is an error, or if the anatomy is another one.   [main]
/// @param session  file, for people
[[nodiscard]] std::optional<run::Scene> scene_of(RecordedDocuments& of_session, const std::string& session,
                                                 DocumentRefusal& refusal);

}  // namespace kerf::app
