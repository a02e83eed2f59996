// SPDX-License-Identifier: Apache-2.0
// A program that runs a procedure and shows it: viewer PROCEDURE PLUGIN_FOLDER
#include <cstdio>
#include <thread>

#include "run/run_procedure.h"
#include "run/scene.h"
#include "run/view/run_view.h"
#include "viewer.h"

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("Usage: viewer PROCEDURE PLUGIN_FOLDER\n", stderr);
        return 2;
    }
    kerf::PluginRegistry plugins;
    plugins.scan({argv[2]});
    const auto scene = kerf::run::make_scene(argv[1], "", plugins);
    if (!scene) {
        std::fputs(kerf::text::to_text(scene.diagnostics()).c_str(), stderr);
        return 2;
    }
    kerf::run::RunView view(*scene, {.mode = "practice", .hand = "a rehearsal"});
    kerf::run::RunRequest request;
    request.observers = {&view};
    std::thread running([&] {
        const kerf::run::RunOutcome outcome = kerf::run::run_procedure(*scene, plugins, request);
        if (!outcome.error.empty()) {
            std::fprintf(stderr, "%s\n", outcome.error.c_str());
            view.close();
        }
    });
    show(view);
    running.join();
    const auto result = view.result();
    return result && result->verdict == "pass" ? 0 : 1;
}
