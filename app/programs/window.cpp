// SPDX-License-Identifier: Apache-2.0
// kerf-window: `kerf window`, `kerf run --window`, `kerf view`.
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/commands.h"
#include "app/program.h"
#include "app/programs/run_displays.h"
#include "app/programs/start_program.h"
#include "app/standard_streams.h"

namespace kerf::app {

namespace {

ExitCode run_in_window(const RunOptions& options, const Installation& here) {
    WindowDisplay display({.folder = options.out.empty() ? "." : options.out, .screenshot = options.screenshot});
    return with_plugins(here, [&](const PluginRegistry& plugins) {
        return commands::run(options, {plugins, here, &display});
    });
}

/// Returns a time of 0 s or more; nothing if the text is none.
std::optional<double> seconds_of(const std::string& text) {
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = status == std::errc{} && end == text.data() + text.size();
    return is_whole && std::isfinite(value) && value >= 0.0 ? std::optional(value) : std::nullopt;
}

ExitCode view(const ViewOptions& options, const Installation& here) {
    const auto at = options.at.empty() ? std::optional(0.0) : seconds_of(options.at);
    if (!at) return complain("`--at` is `" + options.at + "`. Write seconds, as in `--at 20.5`.", exit_bad_input);
    if (!options.screenshot.empty() && !options.frames.empty())
        return complain("`--screenshot` is one picture and `--frames` a film. Leave out one of both.", exit_bad_input);
    std::unique_ptr<RunDisplay> display;
    if (!options.screenshot.empty())
        display =
            PictureDisplay::one(options.screenshot, options.at.empty() ? std::numeric_limits<double>::max() : *at);
    else if (!options.frames.empty())
        display = PictureDisplay::film(options.frames, *at);
    else
        display = std::make_unique<WindowDisplay>(WindowDisplay::Options{.folder = ".", .begins_at = at});
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
        return complain_about_other_command(*line.command);
    });
}
