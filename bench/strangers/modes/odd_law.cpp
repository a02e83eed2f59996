// SPDX-License-Identifier: Apache-2.0
// Further faults of the hostile plugin in its law, its outline and its tables.
#include <time.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "bench/strangers/modes/further.h"

namespace hostile {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr char garbage = 0x5a;

void return_unsound_numbers(kerf_channel& c, kerf_law* law) {
    if (is("nan_d")) c.d[4] = nan_value;
    if (is("nan_follow")) c.follow[0] = nan_value;
    if (is("negative_b")) {
        c.kind = KERF_CONTACT;
        c.b = -5.0;
    }
    if (is("negative_tau")) c.tau = -5.0;
    if (is("infinite_tau")) c.tau = HUGE_VAL;
    if (is("four_billion_channels")) law->count = 4000000000u;
    if (is("null_channels")) law->channel = nullptr;
    if (is("nan_at_exit_leaves")) {
        if (is_first()) std::atexit([] { _exit(0); });
        c.tau = nan_value;
    }
}

void depend_on_what_is_no_input(kerf_channel& c, const void* state) {
    if (is("clock_in_law")) {
        timespec now;
        clock_gettime(CLOCK_MONOTONIC, &now);
        c.tau *= 1.0 + 1e-10 * static_cast<double>(now.tv_nsec % 1000000);
    }
    if (is("random_law")) c.tau *= 1.0 + 1e-10 * std::random_device{}();
    if (is("address_in_law"))
        c.tau *= 1.0 + 1e-15 * static_cast<double>(reinterpret_cast<std::uintptr_t>(state) % 1000003);
}

void write_to_inputs(const kerf_tick_in* in) {
    if (is("writes_the_tick")) const_cast<kerf_tick_in*>(in)->dt = 5.0;
    if (is("writes_the_parameters")) const_cast<double*>(in->tool_params)[0] = 4e-3;
    if (is("writes_the_outline") && in->outline != nullptr)
        const_cast<kerf_profile_point*>(in->outline->profile)[2].radius = 2.5e-3;
    if (is("writes_the_query_table")) const_cast<kerf_bone_query*>(in->bone)->sample = nullptr;
}

void query_oddly(const kerf_bone_query* bone) {
    const kerf_vec3 origin{}, nowhere{nan_value, 1e300, -HUGE_VAL}, none{}, along{0, 0, 1};
    kerf_bone_sample sample{};
    kerf_surface_point point{};
    if (is("queries_nowhere")) {
        bone->sample(bone->bone, &nowhere, 1, &none, 1, &sample);
        bone->nearest(bone->bone, &nowhere, 1, &point);
    }
    if (is("queries_a_null_bone")) bone->sample(nullptr, &origin, 1, &along, 1, &sample);
    if (is("queries_into_null")) bone->sample(bone->bone, &origin, 1, &along, 1, nullptr);
    if (is("queries_four_billion_points")) bone->sample(bone->bone, &origin, 4000000000u, &along, 1, &sample);
}

}  // namespace

void shape_further(kerf_tool_shape* out) {
    if (is("nan_grip")) out->grip_z = nan_value;
    if (is("overruns_profile")) std::memset(out->profile + out->profile_capacity, garbage, 4096);
}

void begin_further(void* state) {
    if (is("overruns_state_in_begin")) std::memset(static_cast<State*>(state) + 1, garbage, 64000);
}

kerf_status resist_further(const kerf_tick_in* in, const void* state, kerf_law* law) {
    kerf_channel& c = law->channel[0];
    if (is("overruns_channels_far")) std::memset(law->channel + KERF_MAX_CHANNELS, garbage, 1 << 16);
    return_unsound_numbers(c, law);
    depend_on_what_is_no_input(c, state);
    write_to_inputs(in);
    query_oddly(in->bone);
    if (is("pushes_by_its_speed"))
        for (int i = 0; i < 3; ++i) law->wrench[i] = 200.0 * static_cast<const State*>(state)->rate[i];
    if (is("shakes")) law->wrench[0] = in->tick % 2 == 0 ? -3.0 : 3.0;
    return is("positive_status_in_resist") ? static_cast<kerf_status>(3) : static_cast<kerf_status>(KERF_OK);
}

kerf_status commit_further(void* state, kerf_commit_out* out) {
    if (is("overruns_state_far")) std::memset(static_cast<State*>(state) + 1, garbage, 1 << 20);
    if (is("infinite_signal")) out->signal[0] = HUGE_VAL;
    if (is("holds_body_77")) out->action[out->action_count++] = {KERF_ACTION_HOLD, 77};
    return is("positive_status_in_commit") ? static_cast<kerf_status>(3) : static_cast<kerf_status>(KERF_OK);
}

void fill_further(const Tables& tables) {
    if (is("wrong_magic")) tables.entry.magic = 1;
    if (is("entry_of_another_size")) tables.entry.size += 8;
    if (is("plugin_id_with_slash")) tables.entry.plugin_id = "../test.hostile";
    if (is("named_kerf_something")) tables.entry.plugin_id = "kerf.hostile";
    if (is("wild_resist"))
        tables.force.resist =
            reinterpret_cast<kerf_status (*)(const kerf_tick_in*, const void*, kerf_law*)>(std::uintptr_t{64});
}

}  // namespace hostile
