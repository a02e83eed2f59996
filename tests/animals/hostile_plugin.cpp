// SPDX-License-Identifier: Apache-2.0
// A plugin with one fault, `kerf_how`, which each library brings along; "nothing_wrong" is sound. A burr of 3 mm whose
// law is one channel along its shaft. A fault of its law comes at tick 1000, when some of a run is recorded.
#include <dlfcn.h>
#include <fenv.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "kerf/abi.h"
#include "kerf/units.hpp"
#include "tests/animals/hostile.h"

// A library with further faults defines them.
namespace hostile {
[[gnu::weak]] void misbehave_further(std::string_view) {}
[[gnu::weak]] void shape_further(kerf_tool_shape*) {}
[[gnu::weak]] void begin_further(void*) {}
[[gnu::weak]] kerf_status resist_further(const kerf_tick_in*, const void*, kerf_law*) { return KERF_OK; }
[[gnu::weak]] kerf_status commit_further(void*, kerf_commit_out*) { return KERF_OK; }
[[gnu::weak]] void fill_further(const Tables&) {}
}  // namespace hostile

namespace {

using namespace hostile;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t fault_tick = 1000;

void lower(__rlimit_resource limit, rlim_t value) {
    rlimit both{};
    getrlimit(limit, &both);
    both.rlim_cur = value;
    setrlimit(limit, &both);
}

/// Writes zeros over the session, whose file is open in this process.
void write_over_the_record() {
    const std::string zeros(100000, '\0');
    for (int file = 3; file < 100; ++file) {
        char name[4096]{};
        const std::string link = "/proc/self/fd/" + std::to_string(file);
        if (readlink(link.c_str(), name, sizeof name - 1) <= 0 || !std::string_view(name).ends_with("/session.db"))
            continue;
        sink = static_cast<int>(pwrite(file, zeros.data(), zeros.size(), 0));
        return;
    }
}

/// Changes what belongs to the host.
void change_the_process(const auto& does) {
    if (does("changes_the_folder")) sink = chdir("/");
    if (does("closes_stdout")) close(STDOUT_FILENO);
    if (does("closes_all_files"))
        for (int file = 3; file < 100; ++file) close(file);
    if (does("lowers_the_file_size")) lower(RLIMIT_FSIZE, 1000);
    if (does("lowers_the_open_files")) lower(RLIMIT_NOFILE, 3);
    if (does("lowers_the_memory")) lower(RLIMIT_AS, 1 << 20);
    if (does("takes_a_signal")) std::signal(SIGSEGV, SIG_DFL);
    if (does("writes_over_the_record") && is_first()) write_over_the_record();
    if (does("prints") && is_first()) {
        std::puts("verdict: pass");
        std::fputs("kerf: all is well\n", stderr);
    }
    if (does("prints_for_ever"))
        for (int i = 0; i < 1000; ++i) std::puts("again and again and again and again and again and again");
}

/// What ends a process or never returns, for each place of a plugin's code: "crashes_in_resist".
void misbehave(std::string_view place) {
    const auto does = [&](std::string_view what) { return hostile::does(what, place); };
    if (does("crashes")) *reinterpret_cast<volatile int*>(static_cast<std::uintptr_t>(sink + 16)) = 1;
    if (does("throws")) throw std::runtime_error("not today");
    if (does("throws_an_int")) throw 7;
    if (does("aborts")) std::abort();
    if (does("exits")) std::exit(0);
    if (does("quick_exits")) std::quick_exit(0);
    if (does("leaves")) _exit(0);
    if (does("recurses")) sink = fall(0);
    if (does("loops"))
        for (;;) sink = sink + 1;
    if (does("sleeps"))
        for (;;) sleep(1000);
    if (does("leaves_by_a_system_call")) syscall(SYS_exit_group, 0);
    if (does("becomes_another_program")) execl("/bin/true", "true", nullptr);
    if (does("kills_itself")) raise(SIGKILL);
    if (does("stops_itself")) raise(SIGSTOP);
    if (does("interrupts_itself")) raise(SIGINT);
    if (does("forks") && is_first() && fork() == 0) _exit(0);
    if (does("copies_itself") && is_first()) syscall(SYS_fork);
    if (does("leaves_on_a_thread")) std::thread([] { _exit(0); }).join();
    if (does("crashes_on_a_thread")) std::thread([] { *reinterpret_cast<volatile int*>(sink + 16) = 1; }).join();
    if (does("leaves_at_exit") && is_first()) std::atexit([] { _exit(0); });
    if (does("sleeps_at_exit") && is_first()) std::atexit([] { sleep(1000); });
    if (does("sets_an_alarm")) {
        const itimerval soon{{0, 1000}, {0, 1000}};
        setitimer(ITIMER_REAL, &soon, nullptr);
    }
    if (does("turns_traps_on")) feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_INEXACT);
    if (does("breaks_the_heap") && is_first()) {
        void* volatile memory = malloc(24);
        std::memset(memory, 0x5a, 100000);
    }
    if (does("drags")) usleep(50000);
    change_the_process(does);
    misbehave_further(place);
}

/// Writes `size` bytes behind the end of an array.
void overrun(void* end, std::size_t size) { std::memset(end, 0x5a, size); }

/// Puts another file into the position of this library, as a build does while a run has it open.
void replace_own_file() {
    Dl_info self{};
    if (dladdr(static_cast<const void*>(kerf_how), &self) == 0) return;
    const std::string file = self.dli_fname, other = file + ".new";
    std::ofstream(other, std::ios::binary) << "another build";
    std::rename(other.c_str(), file.c_str());
}

void wait_for(double seconds) {
    timespec start, now;
    clock_gettime(CLOCK_MONOTONIC, &start);
    do {
        clock_gettime(CLOCK_MONOTONIC, &now);
    } while (static_cast<double>(now.tv_sec - start.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - start.tv_nsec) <
             seconds);
}

// ---- the tool ------------------------------------------------------------------------------------------------------

kerf_status shape(const double*, kerf_tool_shape* out) {
    misbehave("shape");
    if (is("fails_in_shape")) return KERF_FAILED;
    kerf_profile_point points[] = {{0.0, 0.0}, {-1e-3, 1.5e-3}, {-3e-3, 1.5e-3}, {-60e-3, 1.5e-3}};
    if (is("forward_outline")) points[2].z = 1e-3;
    if (is("nan_outline")) points[1].radius = nan_value;
    if (is("negative_outline")) points[1].radius = -1e-3;
    if (out->profile_capacity < std::size(points)) return KERF_CAPACITY;
    std::copy(std::begin(points), std::end(points), out->profile);
    out->profile_count = is("empty_outline") ? 0u : is("huge_outline") ? 2000000000u : 4u;
    out->cutting_count = is("cuts_beyond_its_outline") ? 9u : is("has_an_empty_cutting_part") ? 0u : 3u;
    if (is("has_an_empty_cutting_part")) out->cutting_first = 2;
    if (is("begins_beyond_its_outline")) out->cutting_first = 7;
    if (is("has_a_bore_wider_than_itself")) out->bore = 2e-3;
    if (is("has_too_many_gaps")) out->gap_count = 99;
    if (is("has_a_gap_at_its_tip")) {
        out->gap_count = 1;
        out->gap[0] = {0, 1};
    }
    if (is("has_a_negative_bore")) out->bore = -1e-3;
    if (is("thread_in_its_core")) out->thread_radius = 0.1e-3;
    if (is("thread_without_lead")) out->thread_radius = 2e-3;
    if (is("stays_without_thread")) out->stay_count = 1;
    if (is("gives_another_outline_each_time"))
        points[1].radius = out->profile[1].radius = 1.5e-3 + 1e-6 * (sink = sink + 1);
    out->grip_z = is("is_gripped_in_air") ? 60e-3 : -60e-3;
    shape_further(out);
    return KERF_OK;
}

// ---- the law -------------------------------------------------------------------------------------------------------

/// Returns the distance of a point from bone, negative inside.
double surface_at(const kerf_tick_in* in, const kerf_vec3& point) {
    kerf_surface_point nearest{};
    in->bone->nearest(in->bone->bone, &point, 1, &nearest);
    return nearest.distance;
}

void begin(const kerf_tick_in*, void* state) {
    misbehave("begin");
    *static_cast<State*>(state) = State{};
    begin_further(state);
}

kerf_status resist(const kerf_tick_in* in, const void* state, kerf_law* law) {
    const bool is_time = in->tick >= fault_tick;
    const kerf_vec3 point{0, 0, 0}, along{0, 0, 1};
    kerf_bone_sample sample{};
    in->bone->sample(in->bone->bone, &point, 1, &along, 1, &sample);
    kerf_channel& c = law->channel[0];
    c = kerf_channel{};
    c.kind = KERF_CUT;
    c.id = 7;
    c.d[2] = 1.0;
    c.w = 1e-5;
    c.tau = 0.2 * sample.engagement;
    c.gap = std::min(sample.gap, 1.0);
    law->count = 1;
    if (!is_time) return KERF_OK;
    misbehave("resist");
    if (is("underruns_channels")) std::memset(reinterpret_cast<char*>(law->channel) - 16, 0x5a, 16);
    if (is("counts_in_static_data")) c.eta = 1e-12 * (sink = sink + 1);
    if (is("overruns_channels")) overrun(law->channel + KERF_MAX_CHANNELS, sizeof(kerf_channel));
    if (is("overruns_note")) overrun(law->note + KERF_NOTE_BYTES, 1);
    if (is("nan_delta")) c.delta = nan_value;
    if (is("nan_wrench")) law->wrench[3] = nan_value;
    if (is("negative_stiffness")) c.k = -5.0;
    if (is("no_direction")) c.d[2] = 0.0;
    if (is("narrow_onset")) c.w = 1e-9;
    if (is("unknown_kind")) c.kind = 9;
    if (is("too_many_channels")) law->count = KERF_MAX_CHANNELS + 1;
    if (is("fails_in_resist")) return KERF_FAILED;
    if (is("stiff")) {
        c.kind = KERF_CONTACT;
        c.k = 1e15;
    }
    if (is("pushes")) law->wrench[0] = 1e6;
    if (is("follows_by_far")) c.follow[1] = 1e9;
    const State& before = *static_cast<const State*>(state);
    if (is("pushes_along"))
        std::transform(before.rate, before.rate + 3, law->wrench, [](double r) { return r > 0.0 ? 3.0 : -3.0; });
    if (is("flips_its_stiffness") || is("ratchets")) {
        const double depth = std::max(0.0, -surface_at(in, point));
        const bool is_hard = is("ratchets") ? before.rate[2] < 0.0 : in->tick % 2 == 0;
        c.kind = KERF_CONTACT;
        c.d[2] = 1.0;
        c.k = is_hard ? 60e3 : 10e3;
        c.delta = depth;
    }
    if (is("cuts_without_force")) law->count = 0;
    if (is("allocates")) {
        void* volatile memory = malloc(800000);  // volatile: or the pair is optimised away
        std::fill_n(static_cast<char*>(memory), 800000, '\1');
        free(memory);
    }
    if (is("writes_const_state")) static_cast<State*>(const_cast<void*>(state))->cut = 1.0;
    if (is("slow")) wait_for(2e-4);
    if (is("replaces_its_file") && is_first()) replace_own_file();
    if (is("reads_the_environment") && std::getenv("HOSTILE_FORCE") != nullptr) c.tau *= 2.0;
    return resist_further(in, state, law);
}

kerf_status commit(const kerf_tick_in* in, const kerf_advance* advance, void* state, kerf_commit_out* out) {
    // Not while the host runs the tool up in air, before there is a run.
    const bool is_time = in->tick >= fault_tick && advance->channel_count > 0;
    if (is_time) misbehave("commit");
    const bool cuts = !is("flips_its_stiffness") && !is("ratchets");
    out->action[0] = {KERF_ACTION_CUT, cuts ? KERF_CUT_REGION : 99u};
    out->action_count = 1;
    if (is_time && is("overruns_actions")) overrun(out->action + KERF_MAX_ACTIONS, sizeof(kerf_action));
    if (is_time && is("overruns_signals")) overrun(out->signal + 2, 8);
    if (is_time && is("underruns_state")) std::memset(static_cast<char*>(state) - 8, 0x5a, 8);
    if (is_time && is("overruns_state")) overrun(static_cast<State*>(state) + 1, 16000);
    std::copy(std::begin(advance->rate), std::end(advance->rate), static_cast<State*>(state)->rate);
    if (is_time && is("changes_rounding")) fesetround(FE_UPWARD);
    if (is_time && is("fails_in_commit")) return KERF_FAILED;
    out->signal[0] = is_time && is("nan_signal") ? nan_value : 1.0;
    out->signal[1] = 0.0;
    if (is("unknown_event")) out->action[out->action_count++] = {KERF_ACTION_EVENT, 99};
    if (is("unknown_actions")) {
        out->action[out->action_count++] = {77, 0};
        out->action_count = 4000000000u;
    }
    return is_time ? commit_further(state, out) : KERF_OK;
}

// ---- the tables ----------------------------------------------------------------------------------------------------

namespace dimension = kerf::dimension;

kerf_param parameters[2];
kerf_drive drives[2];
kerf_signal signals[2];
kerf_event events[2];
kerf_tool tool;
kerf_force force;
const char* strategies[] = {"example.burring.groove", "example.burring.groove"};
kerf_component components[3];
constexpr kerf_feature feature{
    .id = "size", .help = "A longer one.", .kind = KERF_FEATURE_EFFECT, .param = 0, .off = 1e-3};

kerf_param sound_parameter() {
    kerf_param p{};
    p.id = "size";
    p.help = "A length.";
    p.dimension = dimension::length;
    p.display_unit = "mm";
    p.min = 1e-3;
    p.max = 5e-3;
    p.def = 3e-3;
    p.source = "assumed";
    return p;
}

kerf_drive sound_drive() {
    kerf_drive d{};
    d.id = "speed";
    d.help = "How fast it turns.";
    d.dimension = dimension::frequency;
    d.display_unit = "rpm";
    d.max = 100.0;
    d.def = 50.0;
    d.least = 1.0;
    return d;
}

void fill_parameters() {
    std::fill(std::begin(parameters), std::end(parameters), sound_parameter());
    parameters[1].id = is("twin_parameters") ? "size" : "other_size";
    kerf_param& p = parameters[0];
    if (is("default_out_of_range")) p.def = 0.5;
    if (is("null_help")) p.help = nullptr;
    if (is("null_source")) p.source = nullptr;
    if (is("null_unit")) p.display_unit = nullptr;
    if (is("null_parameter_id")) p.id = nullptr;
    if (is("unknown_unit")) p.display_unit = "furlong";
    if (is("unit_of_another_dimension")) p.display_unit = "N";
    if (is("length_without_unit")) p.display_unit = "";
    if (is("help_not_utf8")) p.help = "caf\xe9.";
    if (is("help_with_escape")) p.help = "\x1b[2Jgone";
    if (is("infinite_range")) p.max = HUGE_VAL;
}

void fill_drives() {
    std::fill(std::begin(drives), std::end(drives), sound_drive());
    drives[1].id = is("twin_drives") ? "speed" : "trigger";
    kerf_drive& d = drives[0];
    if (is("null_drive_id")) d.id = nullptr;
    if (is("drive_default_out_of_range")) d.def = 5000.0;
    if (is("null_drive_unit")) d.display_unit = nullptr;
}

void fill_signals_and_events() {
    std::fill(std::begin(signals), std::end(signals), kerf_signal{"load", "A force.", dimension::force, "N"});
    signals[1].id = is("twin_signals") ? "load" : "other_load";
    if (is("null_signal_id")) signals[0].id = nullptr;
    events[0] = {"hostile.happened", "It happened."};
    events[1] = {is("twin_events") ? "hostile.happened" : "hostile.ended", "It ended."};
    if (is("foreign_event")) events[0].id = "haptics.held_back";
    if (is("bears_a_name_of_kerf")) events[0].id = "drilling.happened", events[1].id = "drilling.ended";
}

void fill_tool() {
    tool.size = sizeof tool;
    tool.drives = is("null_drives") ? nullptr : drives;
    tool.drive_count = std::size(drives);
    tool.shape = is("null_shape") ? nullptr : &shape;
    if (is("names_a_strategy_twice") || is("names_a_strategy_it_lacks")) {
        tool.strategies = strategies;
        tool.strategy_count = is("names_a_strategy_twice") ? 2 : 1;
        if (is("names_a_strategy_it_lacks")) strategies[0] = "test.hostile.grove";
    }
}

void fill_force() {
    force.size = sizeof force;
    force.state_size = is("huge_state") ? 0xffffffffu : sizeof(State);
    force.state_align = is("odd_alignment") ? 3 : alignof(State);
    force.signals = is("null_signals") ? nullptr : signals;
    force.signal_count = std::size(signals);
    force.events = events;
    force.event_count = std::size(events);
    force.budget_ns = 20000;
    force.max_channels = force.max_points = force.max_queries = 1;
    force.begin = &begin;
    force.resist = is("null_resist") ? nullptr : &resist;
    force.commit = &commit;
}

void fill_components() {
    for (kerf_component& c : components) {
        c.size = sizeof c;
        c.kind = KERF_KIND_TOOL;
        c.version = KERF_TOOL_VERSION;
        c.help = "A burr.";
        c.params = is("null_parameters") ? nullptr : parameters;
        c.param_count = is("huge_parameter_count") ? 1000000000u : std::size(parameters);
        c.tool = &tool;
        c.features = &feature;
        c.feature_count = 1;
    }
    components[0].id = "burr";
    components[1].id = "other_burr";
    components[2].id = "burring";
    components[2].kind = KERF_KIND_FORCE;
    components[2].version = KERF_FORCE_VERSION;
    components[2].force = &force;
    if (is("twin_components")) components[1].id = "burr";
    if (is("component_of_another_world")) components[1].kind = 77;
    if (is("tool_of_another_version")) components[0].version = KERF_TOOL_VERSION + 1;
    if (is("is_fed_backwards")) tool.feed = 9;
    if (is("leaves_out_the_unknown")) force.does_not = 16;
    if (is("uses_what_is_reserved")) components[0].reserved = 1;
    if (is("null_component_id")) components[0].id = nullptr;
    if (is("dangling_parameters")) components[0].params = reinterpret_cast<kerf_param*>(std::uintptr_t{64});
}

kerf_status open(const kerf_host* host) {
    misbehave("open");
    const auto* log = static_cast<const kerf_log*>(host->find(host, KERF_LOG_ID, KERF_LOG_VERSION));
    if (is("talks_when_opened")) log->write(host, KERF_LOG_WARNING, "\x1b[2Jit is cold");
    if (is("never_stops_talking"))
        for (int i = 0; i < 1000; ++i) log->write(host, KERF_LOG_NOTE, "again");
    if (is("asks_for_more") && host->find(host, KERF_LOG_ID, KERF_LOG_VERSION + 1) == nullptr &&
        host->find(host, "kerf.crystal_ball", 1) == nullptr && host->find(host, nullptr, 1) == nullptr)
        return KERF_FAILED;
    return KERF_OK;
}

kerf_entry filled_entry() {
    misbehave("load");
    if (is("changes_rounding_in_load")) fesetround(FE_UPWARD);
    fill_parameters();
    fill_drives();
    fill_signals_and_events();
    fill_tool();
    fill_force();
    fill_components();
    kerf_entry entry{};
    entry.magic = KERF_MAGIC;
    entry.abi = is("wrong_abi") ? 7 : KERF_ABI_VERSION;
    entry.size = sizeof entry;
    entry.component_count = is("huge_component_count") ? 1000000000u : std::size(components);
    entry.layout = KERF_LAYOUT_INIT;
    entry.plugin_id = is("bears_a_name_of_kerf") ? "kerf.drilling" : "test.hostile";
    entry.plugin_version = "0.1.0";
    entry.licence = is("null_licence") ? nullptr : "Apache-2.0";
    entry.toolchain = is("null_toolchain") ? nullptr : "any";
    entry.components = components;
    entry.open = &open;
    fill_further({.entry = entry, .force = force});
    return entry;
}

struct Unloaded {
    ~Unloaded() { misbehave("unload"); }
} unloaded;

}  // namespace

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" const kerf_entry kerf_plugin_entry = filled_entry();
