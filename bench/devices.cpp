// SPDX-License-Identifier: Apache-2.0
// Operations with a hand at a device, through its driver and a stand-in for the device. For training and research; not
// for diagnosis, planning or deciding treatment.
//
//     ./dev bench devices                    the shipped operations on a virtual clock, the awl on the wall clock
//     ./dev bench devices PROCEDURE …        those procedures on a virtual clock
//     ./dev bench devices live PROCEDURE …   those procedures on the wall clock
//
//     virtual   the run through the driver, and the same without it: whether both have the same bits
//     wall      the verdict, late ticks, whether the replay has the same bits; and the time between a state that the
//               stand-in sends and the next command that it gets [ms]
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/devices/haply/haply_stand_in.h"
#include "tests/run/doubled_device.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace kerf;

const std::vector<std::string> all = {
    "pedicle-awl",    "pedicle-burr", "pedicle-screw", "trochanter-fixation", "mandibular-angle-reduction",
    "dental-implant", "amputation"};

void run_virtual(const std::string& procedure) {
    haply::HaplyStandIn device;
    auto link = device.open();
    const kerf_device_facts facts = link->facts();
    const run::RunOutcome led = run::run_in_lock_step(procedure, {}, device, std::move(link));
    const run::RunOutcome direct = run::run_directly(procedure, {}, facts, device);
    const bool is_same = led.error.empty() && led.summary.hash == direct.summary.hash;
    std::printf("haply  %-24s virtual  %8llu ticks  %-10s  %s%s\n", procedure.c_str(),
                static_cast<unsigned long long>(led.summary.ticks), to_text(led.summary.verdict),
                is_same ? "the same bits" : "OTHER BITS", led.error.c_str());
    std::fflush(stdout);
}

void run_on_wall_clock(const std::string& procedure) {
    const test::TemporaryFolder folder;
    haply::HaplyStandIn device;
    const run::LiveAndAgain runs = run::run_live_at(procedure, {}, device, device.open(), folder.path() + "/led");
    std::vector<double> times = device.service.take_answer_times();
    std::sort(times.begin(), times.end());
    const auto at = [&](double part) {
        return times.empty() ? 0.0
                             : 1e3 * times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))];
    };
    const auto& clock = runs.live.summary.clock;
    std::printf("haply  %-24s wall     %8llu ticks  %-10s  %s  late %llu  answer %.3f median, %.3f p99, %.3f p99.9%s\n",
                procedure.c_str(), static_cast<unsigned long long>(runs.live.summary.ticks),
                to_text(runs.live.summary.verdict),
                runs.again.summary.hash == runs.live.summary.hash ? "the same bits" : "OTHER BITS",
                static_cast<unsigned long long>(clock ? clock->over_period : 0), at(0.5), at(0.99), at(0.999),
                runs.live.error.c_str());
    for (const std::string& reason : runs.live.summary.reasons) std::printf("       %s\n", reason.c_str());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> named(argv + 1, argv + argc);
    if (!named.empty() && named.front() == "live") {
        for (std::size_t i = 1; i < named.size(); ++i) run_on_wall_clock(named[i]);
        return 0;
    }
    for (const std::string& procedure : named.empty() ? all : named) run_virtual(procedure);
    if (named.empty()) run_on_wall_clock("pedicle-awl");
}
