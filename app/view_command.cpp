// SPDX-License-Identifier: Apache-2.0
// `kerf view`.
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/interruption.h"
#include "app/language.h"
#include "app/recorded_documents.h"
#include "app/replay.h"
#include "app/run_display.h"
#include "app/seconds.h"
#include "app/shown_in_window.h"
#include "app/standard_streams.h"
#include "run/run_procedure.h"
#include "run/view/recorded_view.h"
#include "run/view/run_view.h"

namespace kerf::app::commands {

namespace {

/// Ends the replay when the display has closed or the user has pressed Ctrl-C.
class Stop final : public run::RunObserver {
public:
    Stop(const Interruption& interruption, run::RunView& view) : interruption_(&interruption), view_(&view) {}
    [[nodiscard]] std::optional<run::RunEnd> end() override {
        if (!interruption_->has_come()) return std::nullopt;
        view_->close();  // before the result of a replay that was cut short
        return run::RunEnd::interrupted;
    }

private:
    const Interruption* interruption_;
    run::RunView* view_;
};

/// Computes the operation once more, and shows it.
/// @param duration  [s]
ExitCode view_replay(const run::Scene& scene, run::RunRequest& request, double duration, const ViewOptions& options,
                     const Environment& with, const Interruption& interruption) {
    run::RunView run_view(
        scene, {.mode = "debrief", .hand = "recorded hand", .language = language_for(options.language)}, duration);
    run_view.request_inspection(options.is_inspecting);
    Stop stop(interruption, run_view);
    request.observers = {&stop, &run_view};
    const run::RunOutcome outcome = run_behind(*with.display, run_view, interruption,
                                               [&] { return run::run_procedure(scene, with.plugins, request); });
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    return interruption.has_come() ? complain("interrupted", exit_fault) : exit_pass;
}

/// Returns why `--at` does not fit a recording, for people; empty if it does.
/// @param duration  [s]
std::string refusal_of_time(const ViewOptions& options, double duration) {
    if (const auto at = seconds_of(options.at); !at || *at <= duration) return {};  // without a time, the end
    return "`--at` is " + options.at + " s, and the recording ends after " + formatted("%.1f", duration) +
           " s. Write an earlier time.";
}

/// Shows the session alone.
/// @param why  a clause for people
ExitCode view_record(const ViewOptions& options, const Environment& with, const std::string& why,
                     const Interruption& interruption) {
    std::string error;
    const auto record = run::RecordedView::read(options.session, why, error);
    if (record == nullptr) return complain(error, exit_bad_input);
    if (error = refusal_of_time(options, record->duration().value_or(0.0)); !error.empty())
        return complain(error, exit_bad_input);
    print_error("kerf: " + options.session + ": " + record->scene().note + "\n");
    if (error = with.display->open(record->scene().title); !error.empty()) return complain(error, exit_fault);
    record->close_if([&] { return interruption.has_come(); });
    if (error = with.display->show(*record); !error.empty()) return complain(error, exit_fault);
    return interruption.has_come() ? complain("interrupted", exit_fault) : exit_pass;
}

/// Shows the session alone if no procedure was required to fit; otherwise prints why the documents do not fit.
ExitCode view_without(const DocumentRefusal& refusal, const ViewOptions& options, const Environment& with,
                      const Interruption& interruption) {
    const bool is_required = !options.procedure.empty() && !options.is_procedure_assumed;
    return is_required ? complain(refusal) : view_record(options, with, refusal.clause, interruption);
}

}  // namespace

ExitCode view(const ViewOptions& options, const Environment& with) {
    if (const std::string refusal = refusal_of_language(options.language); !refusal.empty())
        return complain(refusal, exit_bad_input);
    const Interruption interruption;
    if (options.is_recorded) return view_record(options, with, "`--recorded` requests it", interruption);
    RecordedDocuments of_session;
    if (const auto refusal = read_documents_of(options, with, of_session))
        return view_without(*refusal, options, with, interruption);
    const session::RecordedInputs& recorded = of_session.recorded;
    const double duration = 1e-3 * static_cast<double>(recorded.device_from_handle.size());
    if (const std::string why_not = refusal_of_time(options, duration); !why_not.empty())
        return complain(why_not, exit_bad_input);
    std::unique_ptr<StatedDevice> device;
    if (const std::string why_not = recorded_device(recorded, options.session, device); !why_not.empty())
        return complain(why_not, exit_bad_input);
    if (device != nullptr) of_session.documents->device = &device->record();
    run::RunRequest request;
    if (const std::string error = repeat(recorded, options.session, request); !error.empty())
        return view_without({.clause = "this Kerf does not know one of its inputs", .error = error}, options, with,
                            interruption);
    const documents::Procedure& procedure = of_session.documents->procedure;
    if (const std::string note = note_of_language(options.language, procedure.translations); !note.empty())
        print_error("kerf: " + note + "\n");
    if (const std::string why_not =
            with.display->open(procedure.translations.of(procedure.title, language_for(options.language)));
        !why_not.empty())
        return complain(why_not, exit_fault);
    DocumentRefusal refusal;
    const auto scene = done_behind(
        *with.display, "Making the bone", [] { return 0.5; },
        [&] { return scene_of(of_session, options.session, refusal); }, [] {});
    return scene ? view_replay(*scene, request, duration, options, with, interruption)
                 : view_without(refusal, options, with, interruption);
}

}  // namespace kerf::app::commands
