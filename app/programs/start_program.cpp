// SPDX-License-Identifier: Apache-2.0
#include "app/programs/start_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/attempts.h"
#include "app/interruption.h"
#include "app/language.h"
#include "app/learner_code.h"
#include "app/outputs.h"
#include "app/programs/resumed_run.h"
#include "app/programs/run_displays.h"
#include "app/run_thread.h"
#include "app/standard_streams.h"
#include "app/start_page.h"
#include "app/window/start_window.h"
#include "text/printable.h"
#include "text/system_reason.h"

extern char** environ;

namespace kerf::app {

namespace {

/// Returns why a command has failed: the last message of `kerf`, or else the first error of a document. Notes of import
/// and warnings are left out.
std::string reason_in(const std::string& messages) {
    constexpr std::string_view name = "kerf: ";
    std::string first_error, last_message, line;
    std::istringstream lines(messages);
    while (std::getline(lines, line)) {
        const bool is_error = line.size() > 1 && line[0] == 'E' && line[1] >= '0' && line[1] <= '9';
        if (is_error && first_error.empty()) first_error = line;
        if (line.starts_with(name)) last_message = line.substr(name.size());
    }
    if (!first_error.empty()) return text::excerpt(first_error, 300);
    return last_message.empty() ? "It failed without a message." : text::excerpt(last_message, 300);
}

/// Opens a page in the browser of the desktop, if it has one.
void open_in_browser(const std::string& file) {
    std::array<char*, 3> arguments{const_cast<char*>("xdg-open"), const_cast<char*>(file.c_str()), nullptr};
    pid_t child = 0;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    static_cast<void>(posix_spawnp(&child, "xdg-open", &actions, nullptr, arguments.data(), environ));
    posix_spawn_file_actions_destroy(&actions);
}

/// The start page, and what the user starts on it.
class StartProgram {
public:
    StartProgram(const WindowOptions& options, const Environment& with, std::shared_ptr<window::GlfwWindow> window)
        : options_(&options), with_(with), window_(std::move(window)), pages_(options, with) {
        selection_.learner = options.learner;
    }

    ExitCode run() {
        const auto save = [&](const window::Pixels& pixels) {
            const std::string error = write_picture(options_->attempts + "/start-page.png", pixels);
            pages_.set_message(error.empty() ? "Picture written to " + options_->attempts + "/start-page.png" : error,
                               !error.empty());
        };
        while (true) {
            window_->set_title("Kerf");
            std::string error;
            const auto action = show_page(save, error);
            if (!error.empty()) return complain("the window cannot draw: " + error, exit_fault);
            if (!action) return exit_pass;
            if (action->kind == window::StartAction::Kind::start) start();
            if (action->kind == window::StartAction::Kind::watch)
                watch(pages_.page(selection_).attempts[action->attempt]);
            if (action->kind == window::StartAction::Kind::report)
                report(pages_.page(selection_).attempts[action->attempt]);
            window_->keep_open();
        }
    }

private:
    /// Shows the page. A signal closes it as the user does; during a run it ends the run.
    std::optional<window::StartAction> show_page(const std::function<void(const window::Pixels&)>& save,
                                                 std::string& error) {
        const Interruption interruption;
        return window::show_start(
            *window_, pages_, selection_, save, [&] { return interruption.has_come(); }, error);
    }

    /// Starts the chosen operation, and again or from a moment on as often as the user wants it on the card with the
    /// result.
    void start() {
        using Kind = window::CardAction::Kind;
        WindowDisplay::After after = start_once(chosen());
        while (after.action.kind == Kind::again || after.action.kind == Kind::resume)
            after = start_once(after.action.kind == Kind::again ? chosen()
                                                                : resumed(chosen(), after.folder, after.action.time));
        if (after.action.kind != Kind::debrief) return;
        watch({.procedure = pages_.page(selection_).procedures[selection_.procedure].id, .folder = after.folder},
              after.action.time);
    }

    /// Returns the options of a run of the chosen operation.
    RunOptions chosen() {
        RunOptions run;
        run.procedure = pages_.page(selection_).procedures[selection_.procedure].file;
        run.variant = selection_.variant;
        run.learner = selection_.learner;
        run.is_in_window = true;
        run.hand = selection_.device.empty() ? selection_.rehearsal : "";
        run.device = selection_.device;
        run.mode = selection_.device.empty() ? "demo" : selection_.mode;
        if (run.mode != "exam") run.assist = selection_.assist;
        run.language = options_->language;
        return run;
    }

    /// Carries out the chosen operation as a new attempt. Returns the choice of the user after it.
    WindowDisplay::After start_once(RunOptions run) {
        const window::StartProcedure& procedure = pages_.page(selection_).procedures[selection_.procedure];
        std::string error;
        const std::string folder = make_attempt_folder(options_->attempts, selection_.learner, procedure.id, error);
        if (folder.empty()) {
            pages_.set_message(error, true);
            return {};
        }
        run.out = folder;
        WindowDisplay shown({.folder = folder,
                             .window = window_,
                             .has_start_page = true,
                             .has_again = true,
                             .has_debrief = true,
                             .has_resume = can_be_resumed(run)});
        // A picture in the making takes the processor from a run on the clock.
        shown.wait(
            "Finishing the picture", [] { return 0.5; }, [&] { return pages_.is_idle(); });
        const ErrorCopy errors;
        const ExitCode code = commands::run(run, {with_.plugins, with_.here, &shown});
        remove_empty_attempt(folder);
        pages_.read_attempts_again();
        std::error_code ignored;
        const bool has_ended_early = code == exit_fault && std::filesystem::exists(folder + "/summary.json", ignored);
        if (code == exit_pass || code == exit_not_passed || has_ended_early)
            pages_.set_message((has_ended_early ? "Ended early: the results are in " : "The results are in ") + folder,
                               false);
        else
            pages_.set_message(reason_in(errors.text()), true);
        return shown.after();
    }

    /// @param from  [s]
    void watch(const window::StartAttempt& attempt, double from = 0.0) {
        ViewOptions view;
        view.language = options_->language;
        view.session = attempt.folder + "/session.db";
        for (const window::StartProcedure& one : pages_.page(selection_).procedures)
            if (one.id == attempt.procedure) view.procedure = one.file;
        view.is_procedure_assumed = true;
        WindowDisplay shown({.folder = attempt.folder, .begins_at = from, .window = window_, .has_start_page = true});
        const ErrorCopy errors;
        const ExitCode code = commands::view(view, {with_.plugins, with_.here, &shown});
        pages_.set_message(code == exit_pass ? "" : reason_in(errors.text()), true);
    }

    void report(const window::StartAttempt& attempt) {
        const std::string file = attempt.folder + "/report.html";
        print(file + "\n");
        open_in_browser(file);
        pages_.set_message("Report: " + file, false);
    }

    const WindowOptions* options_;
    Environment with_;
    std::shared_ptr<window::GlfwWindow> window_;
    StartPages pages_;
    window::StartSelection selection_{.device = "mouse"};
};

}  // namespace

ExitCode run_start_page(const WindowOptions& options, const Environment& with) {
    if (const std::string refusal = refusal_of_learner(options.learner); !refusal.empty())
        return complain("`--learner`: " + refusal, exit_bad_input);
    for (const std::string& refusal : {refusal_of_language(options.language), refusal_of_folder(options.attempts)})
        if (!refusal.empty()) return complain(refusal, exit_bad_input);
    std::error_code ignored;
    if (!options.procedures.empty() && !std::filesystem::is_directory(options.procedures, ignored))
        return complain("`--procedures` is `" + options.procedures + "`, which is no folder.", exit_bad_input);
    static_cast<void>(RunThread::of_process());  // before the window lowers the priority of its thread
    std::string error;
    std::shared_ptr<window::GlfwWindow> opened = window::GlfwWindow::open("Kerf", error);
    if (opened == nullptr) return complain(text::with_memory_limit(error), exit_fault);
    return StartProgram(options, with, std::move(opened)).run();
}

}  // namespace kerf::app
