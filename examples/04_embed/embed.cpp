// SPDX-License-Identifier: Apache-2.0
// A program that runs a procedure by itself: embed PROCEDURE PLUGIN_FOLDER
#include <algorithm>
#include <cstdio>

#include "run/run.h"
#include "run/scene.h"

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("Usage: embed PROCEDURE PLUGIN_FOLDER\n", stderr);
        return 2;
    }
    kerf::PluginRegistry plugins;
    plugins.scan({argv[2]});
    const auto scene = kerf::run::make_scene(argv[1], "", plugins);  // an empty anatomy: the procedure's own
    if (!scene) {
        std::fputs(kerf::text::to_text(scene.diagnostics()).c_str(), stderr);
        return 2;
    }
    kerf::run::RunOutcome outcome;
    const auto run =
        kerf::run::Run::create(*scene, plugins, {}, outcome);  // a request with `out` writes the results there
    if (run == nullptr) {
        std::fprintf(stderr, "%s\n", outcome.error.c_str());
        return 2;
    }
    double max_thrust = 0.0;
    while (run->step()) max_thrust = std::max(max_thrust, run->last().thrust);  // `step(sample)` for a device
    outcome = run->finish();
    std::printf("%s after %.1f s, at most %.1f N\n", kerf::session::to_text(outcome.summary.verdict),
                outcome.summary.duration, max_thrust);
    return outcome.summary.verdict == kerf::session::Verdict::pass ? 0 : 1;
}
