// SPDX-License-Identifier: Apache-2.0
// kerf-chart: `kerf chart`.
#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "app/outputs.h"
#include "app/program.h"
#include "app/programs/printed_laws.h"
#include "app/standard_streams.h"
#include "run/exact/exact_strategies.h"
#include "session/recorder.h"
#include "studies/chart/chart_files.h"

namespace kerf::app {
namespace {

/// Starts the strategies whose surfaces are compared. Returns none if one of them cannot be started.
std::map<std::string, std::unique_ptr<bone::RemeshChild>> start_strategies(const run::StrategyHost& host) {
    std::map<std::string, std::unique_ptr<bone::RemeshChild>> started;
    for (const std::string id : chart::surface_strategies) {
        std::string error;
        auto child = run::start_strategy(host, id, {}, error);
        if (child == nullptr) {
            print_error("kerf: " + error + " The chart has no surfaces.\n");
            return {};
        }
        started.emplace(id, std::move(child));
    }
    return started;
}

ExitCode draw_chart(const ChartOptions& options, const PluginRegistry& plugins, const Installation& here) {
    const std::string out = options.out.empty() ? "out/chart" : options.out;
    if (const std::string refusal = refusal_of_folder(out); !refusal.empty()) return complain(refusal, exit_bad_input);
    PluginRegistry printed;
    scan_printed_laws(printed, here);
    if (printed.plugins().empty())
        print_error("kerf: the papers as printed are not in " + here.printed_laws() + ": the chart leaves them out.\n");
    print(std::string(session::notice_line) + ".\n");
    chart::Request request{.scene = options.scene, .is_quick = options.is_quick};
    request.progress = [](const std::string& what) { print_error(what + "\n"); };
    // First, while this process has one thread and little memory.
    const auto strategies = start_strategies(here.strategies(plugins));
    if (!strategies.empty())
        request.strategies = [&](const std::string& id) -> bone::StrategyCall {
            bone::RemeshChild* child = strategies.at(id).get();
            constexpr std::chrono::minutes limit(5);
            return [child, limit](const bone::RemeshRequest& one) { return child->remesh(one, limit); };
        };
    std::string error;
    const chart::Chart drawn = chart::make_chart({&plugins, &printed}, request, error);
    if (!error.empty()) return complain(error, exit_bad_input);
    if (error = chart::write_chart(out, drawn); !error.empty()) return complain(error, exit_fault);
    print(out + "/chart.html\n");
    return exit_pass;
}

}  // namespace
}  // namespace kerf::app

int main(int argc, char** argv) {
    using namespace kerf;
    using namespace kerf::app;
    return run_own_program<ChartOptions>(argc, argv, [](const ChartOptions& options, const Installation& here) {
        return with_plugins(here, [&](const PluginRegistry& plugins) { return draw_chart(options, plugins, here); });
    });
}
