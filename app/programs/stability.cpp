// SPDX-License-Identifier: Apache-2.0
// kerf-stability: `kerf stability`.
#include <cstdio>
#include <string>

#include "app/outputs.h"
#include "app/program.h"
#include "app/programs/printed_laws.h"
#include "app/standard_streams.h"
#include "core/plugin/own_streams.h"
#include "session/recorder.h"
#include "studies/stability/atlas.h"
#include "studies/stability/suite.h"

namespace kerf::app {
namespace {

ExitCode run_stability(const StabilityOptions& options, const PluginRegistry& plugins, const Installation& here) {
    using namespace stability;
    const std::string out = options.out.empty() ? "out/stability" : options.out;
    if (const std::string refusal = refusal_of_folder(out); !refusal.empty()) return complain(refusal, exit_bad_input);
    PluginRegistry printed;
    scan_printed_laws(printed, here);
    print(std::string(session::notice_line) + ".\n" + table_head() + "\n");
    const stability::Report print_line = [](const Finding& finding) {
        print(table_line(finding) + "\n");
        std::fflush(own_output());
    };
    std::string error;
    const auto findings = run_suite(plugins, printed, options.plugin, options.is_quick, print_line, error);
    if (!error.empty()) return complain(error, exit_bad_input);
    print(tally(findings));
    if (error = write_atlas(out, findings); !error.empty()) return complain(error, exit_fault);
    print(out + "/stability.svg\n");
    return is_kerf_stable(findings) ? exit_pass : exit_not_passed;
}

}  // namespace
}  // namespace kerf::app

int main(int argc, char** argv) {
    using namespace kerf;
    using namespace kerf::app;
    return run_own_program<StabilityOptions>(argc, argv, [](const StabilityOptions& options, const Installation& here) {
        return with_plugins(here, [&](const PluginRegistry& plugins) { return run_stability(options, plugins, here); });
    });
}
