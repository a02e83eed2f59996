// SPDX-License-Identifier: Apache-2.0
// The shipped operations by events of mouse and keyboard in a window. For training and research; not for diagnosis,
// planning or deciding treatment.
//
//     ./dev bench window_operations [OPTION …] [PROCEDURE[/REHEARSAL] …]
//
//     --wall-clock          on the wall clock; otherwise on a clock that waits for each frame
//     --here                on the display of the desktop, whose mouse and keyboard it takes for itself; otherwise on
//                           a display of its own, without a screen
//     --pictures FOLDER S   writes a picture of the window every S seconds of the operation
//     --set PATH=VALUE      replaces a value of the procedure
//
//     legs     of the rehearsal that the person at the window follows: completed, and all
//     time     simulated [s]
//     took     on the wall clock [s]
//
// On a desktop it takes mouse and keyboard for itself. The expert of the pedicle screw tilts the drill 3 mm deep, which
// a mouse does not; so the person follows `no-starting-hole`.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/preview/png.h"
#include "app/window/run_window.h"
#include "core/plugin/loader.h"
#include "tests/support/own_display.h"
#include "tests/support/windowed_operation.h"

namespace {

using namespace kerf;

struct Choice {
    bool is_on_wall_clock = false, is_here = false;
    std::string pictures;
    double every = 10.0;  ///< [s]
    std::vector<std::string> changes, names;
};

Choice chosen(const std::vector<std::string>& arguments) {
    Choice choice;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument == "--wall-clock") {
            choice.is_on_wall_clock = true;
        } else if (argument == "--here") {
            choice.is_here = true;
        } else if (argument == "--pictures" && i + 2 < arguments.size()) {
            choice.pictures = arguments[++i];
            choice.every = std::stod(arguments[++i]);
        } else if (argument == "--set" && i + 1 < arguments.size()) {
            choice.changes.push_back(arguments[++i]);
        } else {
            choice.names.push_back(argument);
        }
    }
    if (choice.names.empty())
        choice.names = {
            "pedicle-awl",         "pedicle-screw/no-starting-hole", "pedicle-burr", "dental-implant", "amputation",
            "trochanter-fixation", "mandibular-angle-reduction"};
    return choice;
}

void operate(const std::string& name, const PluginRegistry& plugins, window::GlfwWindow& window, const Choice& choice) {
    const std::size_t slash = name.find('/');
    const std::string procedure = name.substr(0, slash);
    const std::string rehearsal = slash == std::string::npos ? "" : name.substr(slash + 1);
    text::Diagnostics diagnostics;
    run::DocumentRequest request{.procedure = KERF_SOURCE_DIR "/procedures/" + procedure + ".yaml"};
    request.changes = {"", choice.changes};
    auto documents = run::check_documents(request, plugins).take(diagnostics);
    const auto scene = documents ? run::make_scene(std::move(*documents)).take(diagnostics) : std::nullopt;
    if (!scene) {
        std::printf("%s", to_text(diagnostics).c_str());
        return;
    }
    test::OperationAtAWindow operation(*scene, plugins, window);
    double next = 0.0;
    operation.on_frame = [&](const window::RunScreen& screen, double time) {
        if (choice.pictures.empty() || (time < next && !screen.is_over())) return;
        next = time + choice.every;
        char seconds[16];
        std::snprintf(seconds, sizeof(seconds), "-%05.1f.png", time);
        window::Pixels pixels = screen.pixels();
        app::Picture picture(pixels.width, pixels.height);
        picture.rgb = std::move(pixels.rgb);
        std::ofstream(choice.pictures + "/" + procedure + seconds, std::ios::binary) << png_of(picture);
    };
    const auto begun = std::chrono::steady_clock::now();
    const test::WindowedOperation made =
        choice.is_on_wall_clock ? operation.on_wall_clock(rehearsal) : operation.on_virtual_clock(rehearsal);
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    const session::RunSummary& summary = made.outcome.summary;
    std::printf("%-40s %-10s %4zu/%-4zu %7.1f %7.1f\n", name.c_str(), to_text(summary.verdict), made.legs_done,
                made.legs, summary.duration, took);
    for (const std::string& reason : summary.reasons) std::printf("    %s\n", reason.c_str());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    window::prepare_process();
    const Choice choice = chosen({argv + 1, argv + argc});
    PluginRegistry plugins;
    plugins.scan({KERF_BUILD_DIR "/lib/kerf"});
    std::optional<test::OwnDisplay> display;
    if (!choice.is_here) display.emplace();
    std::string error;
    const auto window = window::GlfwWindow::open("kerf", error);
    if (window == nullptr) {
        std::printf("%s\n", error.c_str());
        return 3;
    }
    if (!choice.pictures.empty()) std::filesystem::create_directories(choice.pictures);
    std::printf("%-40s %-10s %9s %7s %7s\n", "operation", "verdict", "legs", "time", "took");
    for (const std::string& name : choice.names) operate(name, plugins, *window, choice);
    return 0;
}
