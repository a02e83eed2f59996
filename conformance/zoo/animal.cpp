// SPDX-License-Identifier: Apache-2.0
// The example's round burr with one fault, `kerf_how`, which each library brings along; the "saint" has none. Each test
// of the kit has an animal here or in tests/animals that fails it first.
#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <kerf/plugin.hpp>
#include <limits>
#include <string_view>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#undef KERF_PLUGIN
#define KERF_PLUGIN(id, version, licence, ...) using Sound = ::kerf::PluginTables<__VA_ARGS__>;
#include "examples/02_round_burr/round_burr.cpp"

extern "C" __attribute__((visibility("hidden"))) const char kerf_how[];

#if defined(KERF_EXPORTS_A_HELPER)
extern "C" __attribute__((visibility("default"))) int helper_of_a_plugin();
extern "C" int helper_of_a_plugin() { return 7; }
#endif

namespace {

const std::string_view how = kerf_how;
bool is(std::string_view fault) { return how == fault; }
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t some_tick = 700;  // after the motor has come to its speed

constexpr const kerf_component& sound_tool = Sound::components[0];
constexpr const kerf_component& sound_law = Sound::components[1];

kerf_param tool_params[8], law_params[8];
kerf_tool tool;
kerf_force force;
kerf_component components[2];
kerf_signal signals[8];

volatile double sink = 0.0;
double counter = 0.0;
thread_local double of_thread = 0.0;
const double* kept = nullptr;

/// What the animals keep behind the sound state.
struct alignas(16) Extra {
    double value;
    const double* pointer;
    unsigned char garbage;
};
constexpr std::size_t extra_offset = (sound_law.force->state_size + 15) / 16 * 16;
Extra& extra_of(void* state) { return *reinterpret_cast<Extra*>(static_cast<std::byte*>(state) + extra_offset); }
const Extra& extra_of(const void* state) {
    return *reinterpret_cast<const Extra*>(static_cast<const std::byte*>(state) + extra_offset);
}

// ---- the tool -----------------------------------------------------------------------------------------------------

kerf_status shape(const double* params, kerf_tool_shape* out) {
    const bool is_widest = params[0] >= sound_tool.params[0].max;
    if (is("refuses_without_words") && is_widest) return KERF_OUT_OF_RANGE;
    if (is("reads_beyond_its_parameters")) sink = params[sound_tool.param_count];
    if (is("ignores_the_capacity")) {
        kerf_profile_point room[64];
        kerf_tool_shape whole = *out;
        whole.profile = room;
        whole.profile_capacity = 64;
        const kerf_status status = sound_tool.tool->shape(params, &whole);
        std::copy_n(room, whole.profile_count, out->profile);
        whole.profile = out->profile;
        whole.profile_capacity = out->profile_capacity;
        *out = whole;
        return status;
    }
    const kerf_status status = sound_tool.tool->shape(params, out);
    if (is("has_a_nan_outline_at_the_end") && is_widest) out->profile[1].radius = nan_value;
    if (is("remembers_shapes")) {
        static double before = 0.0, now = 0.0;  // diameters
        if (params[0] != now) before = now;
        now = params[0];
        out->grip_z -= 1e-3 * before;
    }
    if (is("thinks_in_kilometres"))
        for (std::uint32_t i = 0; i < out->profile_count; ++i)
            out->profile[i] = {1e-3 * out->profile[i].z, 1e-3 * out->profile[i].radius};
    if (is("is_gripped_in_front")) out->grip_z = 90e-3;
    if (is("weighs_too_much")) {
        out->mass = 12.0;
        out->centre_z = -80e-3;
        out->gyration = 50e-3;
    }
    return status;
}

// ---- the law ------------------------------------------------------------------------------------------------------

void begin(const kerf_tick_in* in, void* state) {
    sound_law.force->begin(in, state);
    Extra& extra = extra_of(state);
    const unsigned char garbage = extra.garbage;
    std::memset(&extra, 0, sizeof extra);
    if (is("leaves_garbage_in_its_state")) extra.garbage = garbage;
    extra.pointer = &extra.value;
    if (is("shares_between_instances")) counter = 0.0;
    if (is("depends_on_the_thread")) of_thread = 1.0;  // its first use allocates
    kept = in->drive;
}

/// Between pose and force.
void do_what_is_forbidden(const kerf_tick_in* in) {
    if (is("throws_within")) {
        try {
            throw 7;
        } catch (int thrown) {
            sink = thrown;
        }
    }
    if (is("initialises_at_first_use")) {
        static const double first = std::strtod("1.5", nullptr);
        sink = first;
    }
    if (is("reads_the_clock")) sink = static_cast<double>(std::time(nullptr));
    if (is("draws_random_numbers")) sink = std::rand();
    if (is("locks")) {
        static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
        pthread_mutex_lock(&mutex);
        pthread_mutex_unlock(&mutex);
    }
    if (is("calls_the_system")) sink = static_cast<double>(syscall(SYS_getppid));
    if (is("prints_in_a_tick") && in->tick == some_tick) std::puts("tick");
    if (is("starts_a_thread_in_a_tick") && in->tick == some_tick) {
        pthread_t thread;
        if (pthread_create(
                &thread, nullptr, [](void*) -> void* { return nullptr; }, nullptr) == 0)
            pthread_join(thread, nullptr);
    }
#if defined(__x86_64__)
    if (is("changes_rounding_in_a_tick")) _mm_setcsr(_mm_getcsr() | 0x8040u);  // flush to zero
#endif
}

/// What the bone is at the tip.
kerf_bone_sample at_tip(const kerf_tick_in* in) {
    const kerf_vec3 point{0, 0, 0}, along{0, 0, 1};
    kerf_bone_sample sample{};
    in->bone->sample(in->bone->bone, &point, 1, &along, 1, &sample);
    return sample;
}

kerf_channel* further_channel(kerf_law* law, std::uint32_t kind, std::uint32_t id) {
    kerf_channel* const c = law->channel + law->count++;
    *c = {};
    c->kind = kind;
    c->id = id;
    c->d[2] = 1.0;
    c->w = 1e-6;
    return c;
}

void change_each(kerf_law* law, std::uint32_t kind, auto change) {
    for (std::uint32_t i = 0; i < law->count; ++i)
        if (law->channel[i].kind == kind) change(law->channel[i]);
}
void scale_cut(kerf_law* law, double by) {
    change_each(law, KERF_CUT, [&](kerf_channel& c) {
        c.tau *= by;
        c.eta *= by;
    });
}

/// Faults in some directions only.
void misbehave_in_some_direction(const kerf_tick_in* in, kerf_law* law) {
    const auto each = [&](std::uint32_t kind, auto change) { change_each(law, kind, change); };
    if (is("pulls_itself_along_y")) each(KERF_CUT, [](kerf_channel& c) { c.follow[1] += 1.5 * std::max(0.0, c.d[1]); });
    if (is("is_harder_on_one_side")) each(KERF_CUT, [](kerf_channel& c) { c.eta *= c.d[0] > 0.5 ? 1.3 : 1.0; });
    if (is("turns_the_wrong_way"))
        each(KERF_CUT, [](kerf_channel& c) { std::transform(c.follow, c.follow + 6, c.follow, std::negate()); });
    if (is("cuts_at_its_tip"))
        each(KERF_CUT, [](kerf_channel& c) {
            std::fill(c.d + 3, c.d + 6, 0.0);
            std::fill(c.follow + 3, c.follow + 6, 0.0);
        });
    if (is("is_pulled_into_a_corner"))
        each(KERF_CONTACT, [](kerf_channel& c) {
            if (c.d[0] < -0.4 && c.d[1] < -0.4 && c.d[2] < -0.4) std::transform(c.d, c.d + 6, c.d, std::negate());
        });
    if (is("rests_on_its_tip") && !(in->drive[0] > 0.0))
        each(KERF_CONTACT, [](kerf_channel& c) { c.k *= c.id == 10 ? 1.0 : 0.0; });
    if (is("is_softer_on_one_side")) each(KERF_CONTACT, [](kerf_channel& c) { c.k *= c.d[1] > 0.4 ? 0.5 : 1.0; });
    if (is("rests_by_the_voxel")) each(KERF_CONTACT, [&](kerf_channel& c) { c.k *= in->bone->reach / 1e-3; });
    if (is("rests_at_its_tip")) each(KERF_CONTACT, [](kerf_channel& c) { std::fill(c.d + 3, c.d + 6, 0.0); });
    if (is("removes_sideways_for_nothing")) each(KERF_CUT, [](kerf_channel& c) { c.eta *= std::abs(c.d[2]); });
    if (is("ignores_gaps")) each(KERF_CUT, [](kerf_channel& c) { c.gap = 0.0; });
}

/// Faults in some bone only.
void misbehave_in_some_bone(const kerf_tick_in* in, const Extra& extra, kerf_law* law) {
    const kerf_bone_sample tip = at_tip(in);
    if (is("knows_one_body") && tip.body > 0) law->count = 0;
    if (is("knows_no_second_body")) {
        const kerf_vec3 at[] = {{-0.5e-3, 0.0, -1e-3}, {0.5e-3, 0.0, -1e-3}}, along{0.0, 0.0, 1.0};
        kerf_bone_sample s[2]{};
        in->bone->sample(in->bone->bone, at, 2, &along, 1, s);
        if (s[0].body >= 0 && s[1].body >= 0 && s[0].body != s[1].body) scale_cut(law, 0.5);
    }
    if (tip.engagement > 0.0) {
        if (is("knows_one_tissue")) scale_cut(law, tip.weight[0]);
        if (is("adds_tissues_up") && tip.weight[0] > 0.0 && tip.weight[0] < 1.0) scale_cut(law, 3.0);
        if (is("takes_soft_bone_for_nothing") && tip.density[0] < 800.0) scale_cut(law, 1e-3);
    }
    if (is("remembers_bone") && extra.value > 0.0) {
        kerf_channel* const c = further_channel(law, KERF_FRICTION, 93);
        c->tau = 1.0;
    }
}

/// What only a test of physics notices.
void misbehave_in_bone(const kerf_tick_in* in, const Extra& extra, kerf_law* law) {
    const bool is_running = in->drive[0] > 0.0;
    const auto rub = [&](double force) {
        kerf_channel* const c = further_channel(law, KERF_FRICTION, 92);
        c->tau = force;
        c->w = 1e-4;
    };
    const auto each = [&](std::uint32_t kind, auto change) { change_each(law, kind, change); };
    if (is("touches_from_afar")) each(KERF_CONTACT, [](kerf_channel& c) { c.delta += 0.25e-3; });
    if (is("gives_energy") && extra.value < 0.0) each(KERF_CONTACT, [](kerf_channel& c) { c.k *= 1.3; });
    if (is("pulls_to_one_side"))
        each(KERF_CONTACT, [&](kerf_channel& c) { law->wrench[0] += 1e5 * std::clamp(c.delta, 0.0, 1e-4); });
    if ((is("does_not_touch_at_rest") || is("declares_that_it_does_not_rest")) && !is_running) law->count = 0;
    if (is("chatters")) each(KERF_CONTACT, [&](kerf_channel& c) { c.k *= in->tick % 2 == 0 ? 1.6 : 0.5; });
    if (is("pulls_itself_in")) each(KERF_CUT, [](kerf_channel& c) { c.follow[2] += c.d[2] > 0.5 ? 1.5 : 0.0; });
    if (is("pulls_itself_sideways")) each(KERF_CUT, [](kerf_channel& c) { c.follow[0] += 1.5 * c.d[0]; });
    if (is("grows_blunt_in_air") && is_running) rub(2.0 * at_tip(in).engagement * std::min(extra.value, 100.0));
    if (is("prefers_dense_bone")) {
        const double ratio = 1850.0 / std::max(1.0, at_tip(in).density[0]);
        rub(is_running ? at_tip(in).engagement * std::min(ratio * ratio, 1e3) : 0.0);
    }
    if (is("yields_to_speed")) {
        const double ratio = std::max(0.0, extra.value) / 0.5e-3;
        rub(is_running ? 5.0 * at_tip(in).engagement / (1.0 + ratio * ratio) : 0.0);
    }
    if (is("thinks_in_ticks")) scale_cut(law, in->dt / 1e-3);
    if (is("thinks_in_voxels")) scale_cut(law, in->bone->reach / 1e-3);
    if (is("likes_the_grid")) {
        const kerf_vec3 at{3.5e-3, 0.0, -3e-3};  // by the face, when the burr is as deep as the kit feeds it
        kerf_surface_point s{};
        in->bone->nearest(in->bone->bone, &at, 1, &s);
        if (s.body >= 0 && std::abs(s.normal.x) + std::abs(s.normal.y) < 1e-6) rub(2.0);
    }
    if (is("feels_ghosts") && extra.value > 0.0) rub(2.0);
    if (is("differs_by_process"))
        law->wrench[5] += 1e-6 * static_cast<double>(reinterpret_cast<std::uintptr_t>(&counter) >> 12 & 0xffffu);
    misbehave_in_some_direction(in, law);
    misbehave_in_some_bone(in, extra, law);
    if (is("thinks_in_millimetres_if_wide") && in->tool_params[0] > 6e-3) scale_cut(law, 1000.0);
    if (is("hardens_where_two_parameters_meet") && in->tool_params[0] > 7e-3 && in->force_params[0] > 2e9)
        scale_cut(law, 10.0);
    if (is("caps_a_parameter")) scale_cut(law, std::min(1.0, 0.5 * sound_law.params[0].max / in->force_params[0]));
    if (is("does_not_feel_its_speed")) scale_cut(law, in->drive[0] / (40000.0 / 60.0));
    if (is("yields_to_fast_feed") && extra.value > 5e-3) scale_cut(law, 25e-6 / (extra.value * extra.value));
    if (is("stops_at_once") && extra.value > 1.0 && extra.value < 400.0) law->count = 0;
}

kerf_status resist(const kerf_tick_in* in, const void* state, kerf_law* law) {
    const kerf_status status = sound_law.force->resist(in, state, law);
    do_what_is_forbidden(in);
    const Extra& extra = extra_of(state);
    if (is("has_twin_channels")) {
        further_channel(law, KERF_FRICTION, 90);
        further_channel(law, KERF_FRICTION, 90);
    }
    if (is("pulls_in_air")) law->wrench[2] = 1.0;
    if (is("jumps_into_contact") && at_tip(in).engagement > 0.5) {
        kerf_channel* const c = further_channel(law, KERF_FRICTION, 91);
        c->tau = 5.0;
        c->w = 1e-3;
    }
    if (is("answers_in_turns")) law->wrench[5] += 1e-9 * (counter = 1.0 - counter);
    if (is("remembers_the_densest_bone")) {
        static std::uint64_t of_tick = 0;
        if (in->tick != of_tick) counter = 0.0;
        of_tick = in->tick;
        counter = std::max(counter, at_tip(in).density[0]);
        law->wrench[5] += 1e-12 * counter;
    }
    if (is("counts_for_ever") || is("shares_between_instances")) law->wrench[5] += 1e-9 * counter;
    if (is("points_into_its_state")) law->wrench[5] += *extra.pointer;
    if (is("depends_on_the_thread")) law->wrench[5] += 1e-6 * of_thread;
    if (is("leaves_garbage_in_its_state")) law->wrench[5] += 1e-6 * extra.garbage;
    if (is("writes_its_inputs")) {
        auto* const drive = const_cast<volatile double*>(in->drive);
        drive[0] = in->drive[0];
    }
    if (is("reads_beyond_its_inputs")) sink = in->force_params[sound_law.param_count];
    if (is("writes_beyond_its_channels")) law->channel[KERF_MAX_CHANNELS].id = 0;
    if (is("writes_beyond_its_state"))
        static_cast<volatile std::byte*>(const_cast<void*>(state))[force.state_size] = std::byte{0};
    if (is("keeps_a_pointer")) sink = *kept;
    if (is("changes_its_tables")) law_params[0].help = "Something else.";

    misbehave_in_bone(in, extra, law);
    const bool is_hardest = in->force_params[0] >= sound_law.params[0].max,
               is_thinnest = in->tool_params[0] <= sound_tool.params[0].min;
    if (is("breaks_at_the_end_of_a_parameter") && is_hardest) law->wrench[0] = nan_value;
    if (is("breaks_with_a_thin_tool") && is_thinnest) law->wrench[0] = nan_value;
    if (is("divides_by_the_speed")) law->wrench[5] += 1e-12 * (in->drive[0] / in->drive[0]);
    if (is("knows_one_tick")) law->wrench[5] += 1e-12 * std::sqrt(2e-3 - in->dt);
    if (is("knows_no_soft_bone")) law->wrench[5] += 1e-12 * std::log(std::max(0.0, at_tip(in).density[0]));
    if (is("knows_no_leaps")) law->wrench[5] += extra.value;
    return status;
}

kerf_status commit(const kerf_tick_in* in, const kerf_advance* advance, void* state, kerf_commit_out* out) {
    kerf_tick_in changed = *in;
    if (is("counts_ticks_as_milliseconds")) changed.dt = 1e-3;
    const kerf_status status = sound_law.force->commit(&changed, advance, state, out);
    if (is("counts_for_ever") || is("shares_between_instances")) counter += 1.0;
    Extra& extra = extra_of(state);
    if (is("gives_energy") || is("yields_to_speed")) extra.value = std::clamp(advance->rate[2], -1.0, 1.0);
    if (is("yields_to_fast_feed")) extra.value = std::clamp(std::abs(advance->rate[2]), 0.0, 1.0);
    if (is("grows_blunt_in_air")) extra.value += in->dt;
    if (is("remembers_bone")) extra.value = std::max(0.0, extra.value - in->dt);
    for (std::uint32_t i = 0; is("remembers_bone") && i < advance->channel_count; ++i)
        if (advance->channel[i].kind == KERF_CUT && advance->lambda[i] > 0.01) extra.value = 30e-3;
    if (is("reports_millinewtons")) out->signal[0] *= 1e3;
    const auto torque = [&] {  // about the shaft, of what cuts [N m]
        double sum = 0.0;
        for (std::uint32_t i = 0; i < advance->channel_count; ++i)
            sum += advance->lambda[i] * (advance->channel[i].d[5] + advance->channel[i].follow[5]);
        return std::abs(sum);
    };
    if (is("reports_torque_in_newton_millimetres")) out->signal[2] = 1e3 * torque();
    if (is("forgets_two_pi_in_its_power")) out->signal[2] = out->signal[1] * torque();
    if (is("reports_a_set_speed") && in->drive[0] > 0.0) out->signal[1] = 40000.0 / 60.0;
    if (is("reports_its_largest_force")) out->signal[0] = extra.value = std::max(extra.value, out->signal[0]);
    if (is("feels_ghosts"))
        for (std::uint32_t i = 0; i < advance->channel_count; ++i)
            if (advance->channel[i].kind == KERF_CUT && advance->lambda[i] > 0.1) extra.value = 1.0;
    if (is("stops_at_once")) extra.value = in->drive[0] > 0.0 ? 1.0 : extra.value > 0.0 ? extra.value + 1.0 : 0.0;
    if (is("cuts_nothing"))
        for (std::uint32_t i = 0; i < out->action_count; ++i)
            if (out->action[i].kind == KERF_ACTION_CUT) out->action[i] = out->action[--out->action_count];
    if (is("strips_what_it_has_not")) out->action[out->action_count++] = {KERF_ACTION_CUT, KERF_CUT_THREAD};
    if (is("moves_its_thread_away")) {
        out->thread = nullptr;
        out->thread_count = 1;
    }
    if (is("leaves_half_a_thread")) {
        *out->thread = {};
        out->thread->tool_from_thread.rotation.w = 1.0;
        out->thread->number = KERF_NEW_THREAD;
        out->thread_count = 1;
    }
    if (is("cuts_at_rest") || (is("ignores_its_least") && in->drive[0] > 0.0))
        out->action[out->action_count++] = {KERF_ACTION_CUT, 0};
    if (is("knows_no_leaps") && std::abs(advance->rate[2]) > 1.0) extra_of(state).value = nan_value;
    return status;
}

// ---- the tables ---------------------------------------------------------------------------------------------------

void do_while_loaded() {
    if (is("prints_while_loaded")) std::puts("loaded");
    if (is("ignores_a_signal")) std::signal(SIGFPE, SIG_IGN);
    if (is("leaves_a_file_open")) static_cast<void>(open("/dev/null", O_RDONLY));
    if (is("sets_the_environment")) setenv("HOSTILE", "1", 1);
    if (is("sets_the_locale")) std::setlocale(LC_ALL, "C.UTF-8");
    if (is("starts_a_thread_while_loaded")) {
        pthread_t thread;
        // It begins in the C library: code of this one may be unmapped before a busy machine gets to it.
        const auto wait_for_ever = reinterpret_cast<void* (*)(void*)>(reinterpret_cast<void*>(&pause));
        if (pthread_create(&thread, nullptr, wait_for_ever, nullptr) == 0) pthread_detach(thread);
    }
#if defined(__x86_64__)
    if (is("changes_rounding_while_loaded")) _mm_setcsr(_mm_getcsr() | 0x8040u);
#endif
}

kerf_entry filled_entry() {
    do_while_loaded();
    std::copy_n(sound_tool.params, sound_tool.param_count, tool_params);
    std::copy_n(sound_law.params, sound_law.param_count, law_params);
    tool = *sound_tool.tool;
    tool.shape = &shape;
    force = *sound_law.force;
    force.state_size = static_cast<std::uint32_t>(extra_offset + sizeof(Extra));
    force.state_align = 16;
    force.begin = &begin;
    force.resist = &resist;
    force.commit = &commit;
    components[0] = sound_tool;
    components[0].params = tool_params;
    components[0].tool = &tool;
    components[1] = sound_law;
    components[1].params = law_params;
    components[1].force = &force;
    force.max_channels += 2;  // for what some animals add
    force.max_points += 4;
    force.max_queries += 4;
    std::copy_n(sound_law.force->signals, sound_law.force->signal_count, signals);
    signals[sound_law.force->signal_count] = is("forgets_two_pi_in_its_power")
                                                 ? kerf_signal{"power", "Power.", kerf::dimension::power, "W"}
                                                 : kerf_signal{"torque", "Torque.", kerf::dimension::torque, "N mm"};
    force.signals = signals;
    if (is("forgets_two_pi_in_its_power") || is("reports_torque_in_newton_millimetres")) ++force.signal_count;
    if (is("declares_that_it_does_not_rest")) force.does_not = KERF_DOES_NOT_REST_ON_BONE;
    if (is("declares_fewer_channels")) force.max_channels = 1;
    if (is("declares_fewer_points")) force.max_points = 1;
    if (is("declares_fewer_queries")) force.max_queries = 1;
    if (is("declares_too_little_time")) force.budget_ns = 10;
    kerf_entry entry = Sound::entry("example.round_burr", "0.1.0", "Apache-2.0");
    entry.components = components;
    if (is("has_no_version")) entry.plugin_version = "new";
    return entry;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const kerf_entry kerf_plugin_entry;
extern "C" const kerf_entry kerf_plugin_entry = filled_entry();
