// SPDX-License-Identifier: Apache-2.0
// kerf-window: `kerf window`, `kerf run --window`, `kerf view`, `kerf landmarks`.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

#include "app/commands.h"
#include "app/program.h"
#include "app/programs/landmarks_program.h"
#include "app/programs/resumed_run.h"
#include "app/programs/run_displays.h"
#include "app/programs/start_program.h"
#include "app/seconds.h"
#include "app/standard_streams.h"

namespace kerf::app {

namespace {

/// Returns a folder for a further attempt: "out/screw-2", or the first number above that is free.
std::string next_folder(const std::string& folder) {
    std::error_code ignored;
    for (int number = 2;; ++number) {
        std::string next = folder + "-" + std::to_string(number);
        if (!std::filesystem::exists(next, ignored)) return next;
    }
}

/// Shows the debrief of a run in its window.
ExitCode show_debrief(const RunOptions& run, const WindowDisplay::After& after, const Environment& with,
                      std::shared_ptr<window::GlfwWindow> opened) {
    ViewOptions view;
    view.session = after.folder + "/session.db";
    view.procedure = run.procedure;
    view.anatomy = run.anatomy;
    view.patches = run.patches;
    view.settings = run.settings;
    view.is_procedure_assumed = true;
    WindowDisplay display({.folder = after.folder, .begins_at = after.action.time, .window = std::move(opened)});
    return commands::view(view, {with.plugins, with.here, &display});
}

/// Carries out an operation in a window, and again as often as the user wants it there. Returns how the last one ended.
ExitCode run_in_window(const RunOptions& options, const Installation& here) {
    using Kind = window::CardAction::Kind;
    return with_plugins(here, [&](const PluginRegistry& plugins) {
        RunOptions attempt = options;
        std::shared_ptr<window::GlfwWindow> opened;
        std::string first;  // folder of the first attempt
        while (true) {
            WindowDisplay display({.folder = attempt.out.empty() ? "." : attempt.out,
                                   .screenshot = attempt.screenshot,
                                   .window = opened,
                                   .has_again = true,
                                   .has_debrief = true,
                                   .has_resume = can_be_resumed(attempt)});
            const Environment with{plugins, here, &display};
            const ExitCode code = commands::run(attempt, with);
            const WindowDisplay::After& after = display.after();
            opened = display.window();
            if (after.action.kind == Kind::debrief)
                return std::max(code, show_debrief(attempt, after, with, std::move(opened)));
            const bool resumes = after.action.kind == Kind::resume;
            if (!(resumes || after.action.kind == Kind::again) || after.folder.empty()) return code;
            if (first.empty()) first = after.folder;
            attempt = resumes ? resumed(attempt, after.folder, after.action.time) : options;
            attempt.out = next_folder(first);
        }
    });
}

ExitCode view(const ViewOptions& options, const Installation& here) {
    const auto at = options.at.empty() ? std::optional(0.0) : seconds_of(options.at);
    if (!at) return complain("`--at` is `" + options.at + "`. Write seconds, as in `--at 20.5`.", exit_bad_input);
    if (!options.screenshot.empty() && !options.frames.empty())
        return complain("`--screenshot` is one picture and `--frames` a film. Leave out one of both.", exit_bad_input);
    std::unique_ptr<RunDisplay> display;
    const bool inspects = options.is_inspecting;
    if (!options.screenshot.empty())
        display = PictureDisplay::one(options.screenshot, options.at.empty() ? std::numeric_limits<double>::max() : *at,
                                      inspects);
    else if (!options.frames.empty())
        display = PictureDisplay::film(options.frames, *at, inspects);
    else
        display = std::make_unique<WindowDisplay>(
            WindowDisplay::Options{.folder = ".", .begins_at = at, .is_inspecting = inspects});
    return with_plugins(here, [&](const PluginRegistry& plugins) {
        return commands::view(options, {plugins, here, display.get()});
    });
}

ExitCode show_start(const WindowOptions& options, const Installation& here) {
    return with_plugins(here, [&](const PluginRegistry& plugins) { return run_start_page(options, {plugins, here}); });
}

}  // namespace

}  // namespace kerf::app

int main(int argc, char** argv) {
    using namespace kerf::app;
    kerf::window::prepare_process();
    return run_program(argc, argv, [](const CommandLine& line, const Invocation& call) {
        if (const auto* of_run = std::get_if<RunOptions>(&line.options)) return run_in_window(*of_run, call.here);
        if (const auto* of_window = std::get_if<WindowOptions>(&line.options)) return show_start(*of_window, call.here);
        if (const auto* of_view = std::get_if<ViewOptions>(&line.options)) return view(*of_view, call.here);
        if (const auto* of_bone = std::get_if<LandmarksOptions>(&line.options))
            return run_landmarks(*of_bone, call.here);
        return complain_about_other_command(*line.command);
    });
}
