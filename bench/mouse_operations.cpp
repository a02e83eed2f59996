// SPDX-License-Identifier: Apache-2.0
// The shipped operations by a scripted mouse on a virtual clock. For training and research; not for diagnosis, planning
// or deciding treatment.
//
//     ./dev bench mouse_operations                       all of them
//     ./dev bench mouse_operations PROCEDURE[/REHEARSAL] …   those that are named
//
//     legs     of the rehearsal that the mouse follows: completed, and all
//     time     simulated [s]
//
// The expert of the pedicle screw tilts the drill 3 mm deep, which a mouse does not; so the mouse follows
// `no-starting-hole`.
#include <cstdio>
#include <string>
#include <vector>

#include "core/plugin/loader.h"
#include "run/live_run.h"
#include "tests/support/scripted_mouse.h"

namespace {

using namespace kerf;

void print_run(const std::string& name, const PluginRegistry& plugins) {
    const std::size_t slash = name.find('/');
    const std::string procedure = name.substr(0, slash);
    const std::string rehearsal = slash == std::string::npos ? "" : name.substr(slash + 1);
    text::Diagnostics diagnostics;
    const auto scene =
        run::make_scene(KERF_SOURCE_DIR "/procedures/" + procedure + ".yaml", "", plugins).take(diagnostics);
    if (!scene) {
        std::printf("%s", to_text(diagnostics).c_str());
        return;
    }
    run::MouseBox box;
    test::ScriptedMouse mouse(*scene, box, rehearsal);
    run::RunRequest request;
    request.rehearsal = rehearsal;
    request.observers = {&mouse};
    test::PunctualClock clock;
    const run::RunOutcome made = run::run_on_clock(*scene, plugins, request, clock, box);
    const session::RunSummary& summary = made.summary;
    std::printf("%-40s %-10s %4zu/%-4zu %7.1f\n", name.c_str(), to_text(summary.verdict), mouse.legs_done(),
                mouse.legs(), summary.duration);
    for (const std::string& reason : summary.reasons) std::printf("    %s\n", reason.c_str());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    PluginRegistry plugins;
    plugins.scan({KERF_BUILD_DIR "/lib/kerf"});
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty())
        names = {
            "pedicle-awl",         "pedicle-screw/no-starting-hole", "pedicle-burr", "dental-implant", "amputation",
            "trochanter-fixation", "mandibular-angle-reduction"};
    std::printf("%-40s %-10s %9s %7s\n", "operation", "verdict", "legs", "time");
    for (const std::string& name : names) print_run(name, plugins);
    return 0;
}
