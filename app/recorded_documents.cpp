// SPDX-License-Identifier: Apache-2.0
#include "app/recorded_documents.h"

#include <utility>

#include "app/make_bone.h"
#include "app/procedure_files.h"
#include "app/replay.h"
#include "app/standard_streams.h"
#include "documents/read_procedure.h"

namespace kerf::app {

namespace {

/// Returns the shipped procedure whose text is in the session; empty: none.
std::string shipped_procedure(const SessionOptions& options, const Environment& with,
                              const session::RecordedInputs& recorded) {
    // A copy of the source has them in a folder of its own.
    for (const std::string& folder : {with.here.procedures(), std::string("procedures")})
        for (const std::string& file : procedures_in(folder)) {
            const auto procedure = documents::read_procedure(file, with.plugins.catalog(),
                                                             {recorded.variant, options.settings, options.patches});
            if (procedure && procedure->text == recorded.procedure_text) return file;
        }
    return {};
}

}  // namespace

ExitCode read_documents_of(const SessionOptions& options, const Environment& with, RecordedDocuments& result) {
    std::string error;
    auto recorded = session::read_session(options.session, error);
    if (!recorded) return complain(error, exit_bad_input);
    result.recorded = std::move(*recorded);
    result.file = !options.procedure.empty() ? options.procedure : shipped_procedure(options, with, result.recorded);
    if (result.file.empty())
        return complain(options.session +
                            ": no shipped procedure has the text that it was recorded with. Name its procedure, as in "
                            "`--procedure amputation.yaml`, with the `--patch` and `--set` it was run with.",
                        exit_bad_input);
    text::Diagnostics diagnostics;
    result.documents = run::check_documents({result.file,
                                             options.anatomy,
                                             {result.recorded.variant, options.settings, options.patches},
                                             with.here.procedures()},
                                            with.plugins)
                           .take(diagnostics);
    if (!result.documents) {
        print_error(to_text(diagnostics));
        return exit_bad_input;
    }
    if (error = refusal_of_replay(result.recorded, options.session, result.documents->procedure); !error.empty())
        return complain(error, exit_bad_input);
    return exit_pass;
}

std::optional<run::Scene> scene_of(RecordedDocuments& of_session, const std::string& session) {
    text::Diagnostics diagnostics;
    auto scene = make_bone(std::move(*of_session.documents), of_session.file).take(diagnostics);
    if (!diagnostics.empty()) print_error(to_text(diagnostics));
    if (scene && of_session.recorded.anatomy_hash != scene->anatomy_hash) {
        static_cast<void>(complain(refusal_of_other_text(session), exit_bad_input));
        return std::nullopt;
    }
    return scene;
}

}  // namespace kerf::app
