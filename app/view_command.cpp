// SPDX-License-Identifier: Apache-2.0
// `kerf view`.
#include <cstdlib>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/interruption.h"
#include "app/language.h"
#include "app/recorded_documents.h"
#include "app/replay.h"
#include "app/run_display.h"
#include "app/shown_in_window.h"
#include "app/standard_streams.h"
#include "run/run_procedure.h"
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

}  // namespace

ExitCode view(const ViewOptions& options, const Environment& with) {
    RecordedDocuments of_session;
    if (const ExitCode code = read_documents_of(options, with, of_session); code != exit_pass) return code;
    const session::RecordedInputs& recorded = of_session.recorded;
    const double duration = 1e-3 * static_cast<double>(recorded.device_from_handle.size());
    if (!options.at.empty() && std::strtod(options.at.c_str(), nullptr) > duration)
        return complain("`--at` is " + options.at + " s, and the recording ends after " + formatted("%.1f", duration) +
                            " s. Write an earlier time.",
                        exit_bad_input);
    if (const std::string note = note_of_language(options.language, of_session.documents->procedure.translations);
        !note.empty())
        print_error("kerf: " + note + "\n");
    std::unique_ptr<StatedDevice> device;
    if (const std::string why_not = recorded_device(recorded, options.session, device); !why_not.empty())
        return complain(why_not, exit_bad_input);
    if (device != nullptr) of_session.documents->device = &device->record();
    if (const std::string why_not = with.display->open(of_session.documents->procedure.translations.of(
            of_session.documents->procedure.title, language_for(options.language)));
        !why_not.empty())
        return complain(why_not, exit_fault);
    const Interruption interruption;
    const auto scene = done_behind(
        *with.display, "Making the bone", [] { return 0.5; }, [&] { return scene_of(of_session, options.session); },
        [] {});
    if (!scene) return exit_bad_input;

    run::RunRequest request;
    if (const std::string error = repeat(recorded, options.session, request); !error.empty())
        return complain(error, exit_bad_input);
    run::RunView run_view(
        *scene, {.mode = "debrief", .hand = "recorded hand", .language = language_for(options.language)}, duration);
    Stop stop(interruption, run_view);
    request.observers = {&stop, &run_view};
    const run::RunOutcome outcome = run_behind(*with.display, run_view, interruption,
                                               [&] { return run::run_procedure(*scene, with.plugins, request); });
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    return interruption.has_come() ? complain("interrupted", exit_fault) : exit_pass;
}

}  // namespace kerf::app::commands
