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
#include <iterator>
#include <string>
#include <vector>

#include "bench/empty_law.h"
#include "core/plugin/loader.h"
#include "core/plugin/plugin_call.h"

namespace {

using namespace kerf;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) { return std::chrono::duration<double>(Clock::now() - begun).count(); }

/// [ns] of a call, block by block.
struct CallTimes {
    std::vector<double> blocks;
    [[nodiscard]] double at(double share) {
        std::sort(blocks.begin(), blocks.end());
        return blocks[std::min(blocks.size() - 1,
                               static_cast<std::size_t>(share * static_cast<double>(blocks.size())))];
    }
};

/// An empty `resist` through the host's call into a library, and the same function called within this program. Blocks
/// of the two alternate, so that both have the same machine.
void print_crossing() {
    PluginRegistry plugins;
    plugins.scan({KERF_BUILD_DIR "/bench/plugins"});
    const kerf_component* const loaded = plugins.find("bench.empty", KERF_KIND_FORCE, "empty");
    if (loaded == nullptr) {
        std::puts("the library of the empty law cannot be loaded");
        return;
    }
    using Own = PluginTables<bench::Pin, bench::EmptyLaw>;
    const auto* const own = std::find_if(std::begin(Own::components), std::end(Own::components),
                                         [](const kerf_component& c) { return c.kind == KERF_KIND_FORCE; });
    const kerf_component* volatile through_host = loaded;
    kerf_status (*volatile within)(const kerf_tick_in*, const void*, kerf_law*) = own->force->resist;
    kerf_law answer{};
    kerf_tick_in in{};
    in.size = sizeof in;
    constexpr int blocks = 20000, calls = 100;
    CallTimes host, inside;
    for (int block = 0; block < blocks; ++block) {
        const auto begun = Clock::now();
        for (int i = 0; i < calls; ++i) static_cast<void>(call_resist(*through_host, in, nullptr, answer));
        const auto middle = Clock::now();
        for (int i = 0; i < calls; ++i) static_cast<void>(within(&in, nullptr, &answer));
        const auto end = Clock::now();
        host.blocks.push_back(1e9 * std::chrono::duration<double>(middle - begun).count() / calls);
        inside.blocks.push_back(1e9 * std::chrono::duration<double>(end - middle).count() / calls);
    }
    std::printf(
        "an empty resist         median    p99.9, ns\n  through the host    %7.1f   %7.1f\n  in one library      "
        "%7.1f   %7.1f\n  ratio               %7.2f   %7.2f\n",
        host.at(0.5), host.at(0.999), inside.at(0.5), inside.at(0.999), host.at(0.5) / inside.at(0.5),
        host.at(0.999) / inside.at(0.999));
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
    print_crossing();
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
