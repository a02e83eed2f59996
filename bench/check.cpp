// SPDX-License-Identifier: Apache-2.0
// `kerf check` on the plugins of this tree: what a call into a plugin costs, how long each level takes, and whether
// whole procedures pass. For training and research; not for diagnosis, planning or deciding treatment.
//
//     ./dev bench check              levels 1 to 4
//     ./dev bench check procedures   and level 5, with the shipped procedures: some minutes
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/plugin/plugin_call.h"

namespace {

using namespace kerf;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

/// An empty law, behind pointers that no compiler sees through.
[[gnu::noinline]] void begin(const kerf_tick_in*, void*) {}
[[gnu::noinline]] kerf_status resist(const kerf_tick_in*, const void*, kerf_law* law) {
    law->count = 0;
    return KERF_OK;
}
[[gnu::noinline]] kerf_status commit(const kerf_tick_in*, const kerf_advance*, void*, kerf_commit_out* out) {
    out->action_count = 0;
    return KERF_OK;
}

/// [ns] of one `resist` and one `commit`, the median of 21 blocks.
double crossing() {
    kerf_force force{};
    force.size = sizeof force;
    force.begin = &begin;
    force.resist = &resist;
    force.commit = &commit;
    kerf_component component{};
    component.force = &force;
    const kerf_component* volatile law = &component;
    kerf_law answer{};
    kerf_commit_out out{};
    const kerf_tick_in in{};
    const kerf_advance advance{};
    constexpr int calls = 1000000;
    std::vector<double> blocks;
    for (int block = 0; block < 21; ++block) {
        const auto begun = Clock::now();
        for (int i = 0; i < calls; ++i) {
            static_cast<void>(call_resist(*law, in, nullptr, answer));
            static_cast<void>(call_commit(*law, in, advance, nullptr, out));
        }
        blocks.push_back(1e9 * seconds_since(begun) / calls);
    }
    std::nth_element(blocks.begin(), blocks.begin() + 10, blocks.end());
    return blocks[10];
}

/// Prints what `kerf check` prints last, and how long it took.
bool check(const std::string& plugin, const std::string& options, const std::string& what) {
    const std::string command = std::string(KERF_BUILD_DIR "/bin/kerf check " KERF_BUILD_DIR "/lib/kerf/kerf_") +
                                plugin + ".so " + options + " | tail -n 1";
    std::printf("%-10s %-22s ", plugin.c_str(), what.c_str());
    std::fflush(stdout);
    const auto begun = Clock::now();
    const int status = std::system(command.c_str());
    std::printf("%33s %.1f s\n", "", seconds_since(begun));
    return WIFEXITED(status);
}

}  // namespace

int main(int argc, char** argv) {
    std::puts("For training and research; not for diagnosis, planning or deciding treatment.");
    std::printf("one resist and one commit of an empty law: %.1f ns\n", crossing());
    const bool with_procedures = argc > 1 && std::string(argv[1]) == "procedures";
    for (const char* plugin : {"drilling", "sawing"}) {
        check(plugin, "--level 3", "levels 1 to 3");
        check(plugin, "--level 4", "levels 1 to 4");
    }
    if (!with_procedures) return 0;
    const std::string from = KERF_SOURCE_DIR "/procedures/";
    check("drilling",
          "--level 5 --only ^procedure --procedure " + from + "pedicle-screw.yaml --procedure " + from +
              "pedicle-awl.yaml",
          "level 5");
    check("sawing", "--level 5 --only ^procedure --procedure " + from + "amputation.yaml", "level 5");
}
