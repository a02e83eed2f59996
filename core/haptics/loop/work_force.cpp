// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/work_force.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/plugin/law_memory.h"
#include "core/plugin/plugin_call.h"

namespace kerf {

namespace {

/// Samples air everywhere.
void sample_air(const kerf_bone*, const kerf_vec3*, std::uint32_t count, const kerf_vec3*, std::uint32_t,
                kerf_bone_sample* out) {
    for (std::uint32_t i = 0; i < count; ++i) {
        out[i] = kerf_bone_sample{};
        out[i].body = -1;
    }
}

/// Infinite bone of one material: every sample is the same.
struct EndlessBone {
    std::size_t material;
    double density;
};

void sample_endless(const kerf_bone* bone, const kerf_vec3*, std::uint32_t count, const kerf_vec3*, std::uint32_t,
                    kerf_bone_sample* out) {
    const auto* endless = reinterpret_cast<const EndlessBone*>(bone);
    for (std::uint32_t i = 0; i < count; ++i) {
        out[i] = kerf_bone_sample{};
        out[i].engagement = 1.0;
        out[i].weight[endless->material] = 1.0;
        out[i].density[endless->material] = endless->density;
    }
}

/// Reports no surface within 1 m: the hole is as wide as the shank, which touches nothing.
void nearest_endless(const kerf_bone*, const kerf_vec3*, std::uint32_t count, kerf_surface_point* out) {
    for (std::uint32_t i = 0; i < count; ++i) {
        out[i] = kerf_surface_point{};
        out[i].body = -1;
        out[i].distance = 1.0;
    }
}

/// Commits the law for up to 10 s of ticks in air, so that a powered tool reaches its speed.
void run_up(const ToolSetup& setup, kerf_tick_in in, LawMemory& memory) {
    constexpr int longest = 10000;  // ticks
    kerf_advance advance{};
    advance.size = sizeof advance;
    for (int i = 0; i < longest; ++i) {
        in.tick = static_cast<std::uint64_t>(i);
        if (call_commit(*setup.force, in, advance, memory.state(), memory.new_commit_out()) != KERF_OK) return;
    }
}

}  // namespace

struct EndlessBoneLaw::State {
    const ToolSetup* setup;
    std::uint32_t tissues;
    std::unique_ptr<LawMemory> law;
    ToolOutline outline;
    kerf_solid solid{};
};

EndlessBoneLaw::EndlessBoneLaw(const ToolSetup& setup, std::size_t tissues) : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.setup = &setup;
    state.tissues = static_cast<std::uint32_t>(tissues);
    std::string error;
    if (!outline_of(setup, state.outline, error)) return;
    state.solid = state.outline.solid();

    const kerf_force& force = *setup.force->force;
    state.law = std::make_unique<LawMemory>(force.state_size + force.state_align);
    state.law->fit(force);
    const kerf_bone_query air{sizeof(kerf_bone_query), state.tissues, 1.0,    &sample_air,
                              &nearest_endless,        nullptr,       nullptr};
    kerf_tick_in in_air = tick_in_of(setup, air, HapticLoop::dt);
    in_air.outline = &state.solid;
    call_begin(*setup.force, in_air, state.law->state());
    run_up(setup, in_air, *state.law);
}

EndlessBoneLaw::~EndlessBoneLaw() = default;

double EndlessBoneLaw::force(std::size_t material, double density, double feed_rate) const {
    if (state_->law == nullptr) return 0.0;
    const EndlessBone endless{material, density};
    const kerf_bone_query query{sizeof(kerf_bone_query),
                                state_->tissues,
                                1.0,
                                &sample_endless,
                                &nearest_endless,
                                nullptr,
                                reinterpret_cast<const kerf_bone*>(&endless)};
    kerf_tick_in in = tick_in_of(*state_->setup, query, HapticLoop::dt);
    in.outline = &state_->solid;
    kerf_law& law = state_->law->new_law();
    const kerf_channel* const channels = law.channel;
    if (call_resist(*state_->setup->force, in, state_->law->state(), law) != KERF_OK) return 0.0;
    double along = 0.0;
    for (std::uint32_t c = 0; c < std::min(law.count, KERF_MAX_CHANNELS); ++c)
        if (is_sound(channels[c]))
            along += channels[c].d[2] * channel_force(channels[c], channels[c].d[2] * feed_rate, HapticLoop::dt).lambda;
    return along;
}

double work_force(const ToolSetup& setup, const Body& body, double feed_rate) {
    const EndlessBoneLaw law(setup, body.materials.size());
    double largest = 0.0;
    for (std::size_t m = 0; m < body.materials.size(); ++m)
        largest = std::max(largest, law.force(m, body.materials[m].density, feed_rate));
    return largest;
}

}  // namespace kerf
