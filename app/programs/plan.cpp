// SPDX-License-Identifier: Apache-2.0
// kerf-plan: `kerf plan`.
#include <string>

#include "app/outputs.h"
#include "app/program.h"
#include "app/programs/plan_procedure.h"
#include "app/read_scene.h"
#include "app/standard_streams.h"

namespace kerf::app {
namespace {

ExitCode plan(const PlanOptions& options, const PluginRegistry& plugins, const Installation& here) {
    if (const std::string refusal = options.out.empty() ? "" : refusal_of_folder(options.out); !refusal.empty())
        return complain(refusal, exit_bad_input);
    const auto scene = read_scene(options.procedure, options, {plugins, here});
    if (!scene) return exit_bad_input;
    const PlanOutcome outcome = plan_procedure(*scene, plugins, options.out, here.strategies(plugins),
                                               [](const std::string& text) { print(text); });
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_planned ? exit_fault : exit_bad_input);
    return outcome.is_kept ? exit_pass : exit_not_passed;
}

}  // namespace
}  // namespace kerf::app

int main(int argc, char** argv) {
    using namespace kerf;
    using namespace kerf::app;
    return run_own_program<PlanOptions>(argc, argv, [](const PlanOptions& options, const Installation& here) {
        return with_plugins(here, [&](const PluginRegistry& plugins) { return plan(options, plugins, here); });
    });
}
