// SPDX-License-Identifier: Apache-2.0
#include "app/recorded_documents.h"

#include <algorithm>
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

/// Returns the refusal by the first error of a document.
DocumentRefusal refusal_by(const std::string& what, const text::Diagnostics& findings) {
    const auto is_error = [](const text::Diagnostic& one) { return one.level == text::Diagnostic::Level::error; };
    const auto first = std::find_if(findings.begin(), findings.end(), is_error);
    const std::string code = first == findings.end() ? "" : " (" + first->code + ")";
    return {.clause = what + " cannot be used" + code, .findings = findings};
}

}  // namespace

ExitCode complain(const DocumentRefusal& refusal) {
    if (!refusal.findings.empty()) print_error(to_text(refusal.findings));
    return refusal.error.empty() ? exit_bad_input : complain(refusal.error, exit_bad_input);
}

std::optional<DocumentRefusal> read_documents_of(const SessionOptions& options, const Environment& with,
                                                 RecordedDocuments& result) {
    std::string error;
    auto recorded = session::read_session(options.session, error);
    if (!recorded) return DocumentRefusal{.clause = "it cannot be repeated", .error = error};
    result.recorded = std::move(*recorded);
    if (error = refusal_of_changed(result.recorded, options.session); !error.empty())
        return DocumentRefusal{.clause = "it was changed after its run", .error = error};
    result.file = !options.procedure.empty() ? options.procedure : shipped_procedure(options, with, result.recorded);
    if (result.file.empty())
        return DocumentRefusal{
            .clause = "no procedure with its text and plugins was found",
            .error = options.session +
                     ": no shipped procedure has the text that it was recorded with. Name its procedure, as in "
                     "`--procedure amputation.yaml`, with the `--patch` and `--set` it was run with."};
    text::Diagnostics diagnostics;
    result.documents = run::check_documents({result.file,
                                             options.anatomy,
                                             {result.recorded.variant, options.settings, options.patches},
                                             with.here.procedures()},
                                            with.plugins)
                           .take(diagnostics);
    if (!result.documents) return refusal_by("its procedure", diagnostics);
    if (error = refusal_of_replay(result.recorded, options.session, result.documents->procedure); !error.empty())
        return DocumentRefusal{.clause = "its procedure has another text now", .error = error};
    return std::nullopt;
}

std::optional<run::Scene> scene_of(RecordedDocuments& of_session, const std::string& session,
                                   DocumentRefusal& refusal) {
    text::Diagnostics diagnostics;
    auto scene = make_bone(std::move(*of_session.documents), of_session.file).take(diagnostics);
    if (!scene) {
        refusal = refusal_by("its bone", diagnostics);
        return std::nullopt;
    }
    if (!diagnostics.empty()) print_error(to_text(diagnostics));
    if (of_session.recorded.anatomy_hash == scene->anatomy_hash) return scene;
    refusal = {.clause = "its anatomy is another one now", .error = refusal_of_other_text(session)};
    return std::nullopt;
}

}  // namespace kerf::app
