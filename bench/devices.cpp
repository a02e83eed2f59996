// SPDX-License-Identifier: Apache-2.0
// Operations with a hand at a device, through its driver and a stand-in for the device. For training and research; not
// for diagnosis, planning or deciding treatment.
//
//     ./dev bench devices                    the shipped operations on a virtual clock, the awl on the wall clock
//     ./dev bench devices PROCEDURE …        those procedures on a virtual clock
//     ./dev bench devices live PROCEDURE …   those procedures on the wall clock
//     ./dev bench devices knob PROCEDURE …   the same with a Touch that leads the tool, and a knob that turns it
//
//     virtual   the run through the driver, and the same without it: whether both have the same bits
//     wall      the verdict, late ticks, whether the replay has the same bits. `haply`: also the time between a state
//               that the stand-in sends and the next command that it gets [ms]. Sessions stay in bench/devices of the
//               build
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/devices/force_dimension/force_dimension_stand_in.h"
#include "tests/devices/haply/haply_stand_in.h"
#include "tests/devices/hid_force/knob_stand_in.h"
#include "tests/devices/openhaptics/openhaptics_stand_in.h"
#include "tests/run/doubled_device.h"
#include "tests/run/stylus_and_knob.h"

namespace {

using namespace kerf;

const std::vector<std::string> all = {
    "pedicle-awl",    "pedicle-burr", "pedicle-screw", "trochanter-fixation", "mandibular-angle-reduction",
    "dental-implant", "amputation"};

template <class Device>
void run_virtual(const char* driver, const std::string& procedure) {
    Device device;
    auto link = device.open();
    const kerf_device_facts facts = link->facts();
    const run::RunOutcome led = run::run_in_lock_step(procedure, {}, device, std::move(link));
    const run::RunOutcome direct = run::run_directly(procedure, {}, facts, device);
    const bool is_same = led.error.empty() && led.summary.hash == direct.summary.hash;
    std::printf("%-16s %-26s virtual  %8llu ticks  %-10s  %s%s\n", driver, procedure.c_str(),
                static_cast<unsigned long long>(led.summary.ticks), to_text(led.summary.verdict),
                is_same ? "the same bits" : "OTHER BITS", led.error.c_str());
    if (!is_same)
        std::printf("    without the driver: %llu ticks, %s\n", static_cast<unsigned long long>(direct.summary.ticks),
                    to_text(direct.summary.verdict));
    for (const std::string& reason : led.summary.reasons) std::printf("    %s\n", reason.c_str());
    std::fflush(stdout);
}

std::string answers(haply::HaplyStandIn& device) {
    std::vector<double> times = device.service.take_answer_times();
    if (times.empty()) return "";
    std::sort(times.begin(), times.end());
    const auto at = [&](double part) {
        return std::to_string(1e3 * times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))])
            .substr(0, 5);
    };
    return "  answer " + at(0.5) + " median, " + at(0.99) + " p99, " + at(0.999) + " p99.9";
}
std::string answers(run::StandIn& /*device*/) { return ""; }

/// Returns the empty folder of a run's results.
std::string results_of(const std::string& driver, const std::string& procedure) {
    const std::string folder = KERF_BUILD_DIR "/bench/devices/" + driver + "-" + procedure;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(KERF_BUILD_DIR "/bench/devices");
    return folder;
}

void print_live(const std::string& driver, const std::string& procedure, const run::LiveAndAgain& runs,
                const std::string& more) {
    const auto& clock = runs.live.summary.clock;
    std::printf("%-16s %-26s wall     %8llu ticks  %-10s  %s  late %llu%s%s\n", driver.c_str(), procedure.c_str(),
                static_cast<unsigned long long>(runs.live.summary.ticks), to_text(runs.live.summary.verdict),
                runs.again.summary.hash == runs.live.summary.hash ? "the same bits" : "OTHER BITS",
                static_cast<unsigned long long>(clock ? clock->over_period : 0), more.c_str(), runs.live.error.c_str());
    for (const std::string& reason : runs.live.summary.reasons) std::printf("    %s\n", reason.c_str());
    std::fflush(stdout);
}

template <class Device>
void run_on_wall_clock(const std::string& driver, const std::string& procedure) {
    Device device;
    const run::LiveAndAgain runs =
        run::run_live_at(procedure, {}, device, device.open(), results_of(driver, procedure));
    print_live(driver, procedure, runs, answers(device));
}

void run_with_knob(const std::string& procedure) {
    openhaptics::OpenHapticsStandIn stylus;
    hid_force::EmulatedKnob knob;
    run::StylusAndKnob both(stylus, knob);
    const run::LiveAndAgain runs = run::run_live_at(procedure, {}, both, openhaptics::OpenHapticsStandIn::open(),
                                                    results_of("knob", procedure), knob.open());
    print_live("knob", procedure, runs,
               "  largest torque " + std::to_string(1e3 * knob.largest_torque()).substr(0, 6) + " mN m" + knob.fault());
}

void run_all_virtual(const std::string& procedure) {
    run_virtual<haply::HaplyStandIn>("haply", procedure);
    run_virtual<force_dimension::ForceDimensionStandIn>("force_dimension", procedure);
    run_virtual<openhaptics::OpenHapticsStandIn>("openhaptics", procedure);
}
void run_all_on_wall_clock(const std::string& procedure) {
    run_on_wall_clock<haply::HaplyStandIn>("haply", procedure);
    run_on_wall_clock<force_dimension::ForceDimensionStandIn>("force_dimension", procedure);
    run_on_wall_clock<openhaptics::OpenHapticsStandIn>("openhaptics", procedure);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> named(argv + 1, argv + argc);
    if (!named.empty() && named.front() == "live") {
        for (std::size_t i = 1; i < named.size(); ++i) run_all_on_wall_clock(named[i]);
        return 0;
    }
    if (!named.empty() && named.front() == "knob") {
        for (std::size_t i = 1; i < named.size(); ++i) run_with_knob(named[i]);
        return 0;
    }
    for (const std::string& procedure : named.empty() ? all : named) run_all_virtual(procedure);
    if (named.empty()) run_all_on_wall_clock("pedicle-awl");
}
