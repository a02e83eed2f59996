// SPDX-License-Identifier: Apache-2.0
// Whole operations on the wall clock, with one busy core next to them, each replayed in lock-step. For training and
// research; not for diagnosis, planning or deciding treatment.
//
//     ./dev bench live                        the pedicle screw and the amputation
//     ./dev bench live PROCEDURE [N] …        shipped procedures by name, each N times
//
//     compute     processor time of the haptic thread from the pose until the tick is done [us]
//     late        ticks that began more than a period late, by cause
//     changes     changes of tool and bodies that the loop took over later than in lock-step
//     replay      the recorded session in lock-step: whether it has the same bits
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/replay.h"
#include "core/plugin/loader.h"
#include "run/live_run.h"
#include "session/read_session.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace kerf;

/// Keeps a core busy until destroyed.
class BusyCore {
public:
    ~BusyCore() {
        is_over_ = true;
        thread_.join();
    }

private:
    std::atomic<bool> is_over_{false};
    std::thread thread_{[this] {
        volatile double sum = 0.0;
        while (!is_over_)
            for (int i = 1; i < 1000; ++i) sum = sum + 1.0 / i;
    }};
};

std::optional<run::Scene> scene_of(const std::string& name, const PluginRegistry& plugins) {
    text::Diagnostics diagnostics;
    auto scene = run::make_scene(KERF_SOURCE_DIR "/procedures/" + name + ".yaml", "", plugins).take(diagnostics);
    if (!scene) std::printf("%s", to_text(diagnostics).c_str());
    return scene;
}

/// Prints the row of one run. Returns whether its replay has the same bits.
bool run_live_and_replay(const std::string& name, const run::Scene& scene, const PluginRegistry& plugins) {
    const test::TemporaryFolder folder;
    run::RunRequest request;
    request.out = folder / "live";
    run::RunOutcome live;
    {
        const BusyCore busy;
        live = run::run_live(scene, plugins, request);
    }
    if (!live.error.empty() || !live.summary.clock) {
        std::printf("%s\n", live.error.c_str());
        return false;
    }
    std::string error;
    const auto recorded = session::read_session(request.out + "/session.db", error);
    run::RunRequest again;
    const bool is_read = recorded && app::repeat(*recorded, "session.db", again).empty();
    const bool is_same = is_read && run::run_procedure(scene, plugins, again).summary.hash == live.summary.hash;

    const session::ClockRow& clock = *live.summary.clock;
    std::printf("%-28s %8llu  %7.1f %7.1f %8.1f  %5llu  ", name.c_str(), static_cast<unsigned long long>(clock.ticks),
                clock.compute.median * 1e6, clock.compute.p999 * 1e6, clock.compute.worst * 1e6,
                static_cast<unsigned long long>(clock.over_period));
    for (const auto& [cause, count] : clock.late_causes)
        if (count > 0) std::printf("%s: %llu; ", cause.c_str(), static_cast<unsigned long long>(count));
    std::printf(" %zu  %s  %s\n", recorded ? recorded->late_changes.size() : 0, to_text(live.summary.verdict),
                is_same ? "the same bits" : "OTHER BITS");
    std::fflush(stdout);
    return is_same;
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::pair<std::string, int>> operations;
    for (int i = 1; i < argc; ++i) {
        const int times = std::atoi(argv[i]);
        if (times > 0 && !operations.empty())
            operations.back().second = times;
        else
            operations.emplace_back(argv[i], 1);
    }
    if (operations.empty()) operations = {{"pedicle-screw", 1}, {"amputation", 1}};

    PluginRegistry plugins;
    plugins.scan({KERF_BUILD_DIR "/lib/kerf"});
    std::printf("%-28s %8s  %23s  %5s  %s\n%-28s %8s  %7s %7s %8s  %5s  %s\n", "", "", "compute [us]", "over", "",
                "operation", "ticks", "median", "p99.9", "worst", "1 ms",
                "late by cause, late changes, verdict, replay");
    int runs = 0, same = 0;
    for (const auto& [name, times] : operations) {
        const auto scene = scene_of(name, plugins);
        if (!scene) return EXIT_FAILURE;
        for (int i = 0; i < times; ++i, ++runs) same += run_live_and_replay(name, *scene, plugins) ? 1 : 0;
    }
    std::printf("%d of %d replays have the same bits\n", same, runs);
    return same == runs ? EXIT_SUCCESS : EXIT_FAILURE;
}
