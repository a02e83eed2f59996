// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/voxel_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/haptics/law/channel.h"
#include "core/plugin/plugin_call.h"
#include "studies/times.h"

namespace kerf::chart {

VoxelRun::VoxelRun(Setting setting, const Fineness& fineness, VoxelBone::Reading reading, Removal removal, double gain,
                   Swept swept)
    : setting_(std::move(setting)),
      bone_(setting_.bone, fineness.spacing, fineness.offset, reading),
      removal_(removal),
      gain_(gain),
      loss_(setting_.feed * dt / fineness.spacing),  // gone when an edge has crossed it at the scene's feed
      swept_(std::move(swept)),
      visited_{setting_.start},
      state_(setting_.setup.force->force->state_size / sizeof(std::max_align_t) + 1) {
    const kerf_tick_in in = tick_in_of(setting_.setup, bone_.query(), dt);
    call_begin(*setting_.setup.force, in, state_.data());
}

Felt VoxelRun::tick(const Pose& next) {
    Felt felt;
    felt.from = visited_.back();
    const Vec6 rate = felt.rate = rate_between(felt.from, next);
    const ToolSetup& setup = setting_.setup;
    kerf_channel channels[KERF_MAX_CHANNELS];
    kerf_law law{sizeof(kerf_law), 0, channels, {}, {}};
    double lambda[KERF_MAX_CHANNELS] = {};
    bone_.place(felt.from);
    felt.cost = processor_time_of([&] {
        const kerf_tick_in in = tick_in_of(setup, bone_.query(), dt);
        if (call_resist(*setup.force, in, state_.data(), law) != KERF_OK) law.count = 0;
        kerf_advance advance{};
        for (std::size_t i = 0; i < 6; ++i) felt.wrench[i] = gain_ * (advance.following[i] = law.wrench[i]);
        for (std::uint32_t c = 0; c < law.count; ++c) {
            lambda[c] = channel_force(channels[c], dot(direction(channels[c]), rate), dt).lambda;
            for (std::size_t i = 0; i < 6; ++i) {
                advance.following[i] += channels[c].follow[i] * lambda[c];
                felt.wrench[i] += gain_ * (channels[c].follow[i] - channels[c].d[i]) * lambda[c];
            }
        }
        advance.size = sizeof advance;
        advance.channel_count = law.count;
        std::copy(rate.begin(), rate.end(), advance.rate);
        advance.channel = channels;
        advance.lambda = lambda;
        advance.note = law.note;
        kerf_action actions[KERF_MAX_ACTIONS];
        kerf_commit_out out{};
        out.size = sizeof out;
        out.action = actions;
        out.signal = signals_;
        if (removal_ == Removal::where_asked) bone_.wear(loss_);
        static_cast<void>(call_commit(*setup.force, in, advance, state_.data(), out));
        bone_.stop_wearing();
    });
    visited_.push_back(next);
    return felt;
}

double VoxelRun::removed_volume() {
    if (removal_ == Removal::when_finished) bone_.take(swept_(visited_));
    return bone_.removed_volume();
}

}  // namespace kerf::chart
