// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/voxel_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/haptics/channel.h"
#include "core/plugin/plugin_call.h"
#include "studies/times.h"

namespace kerf::chart {

VoxelRun::VoxelRun(const Scene& scene, ToolSetup setup, const Fineness& fineness, VoxelBone::Reading reading,
                   Removal removal, double gain)
    : scene_(scene),
      setup_(std::move(setup)),
      bone_(scene.bone, fineness.spacing, fineness.offset, reading),
      removal_(removal),
      gain_(gain),
      loss_(scene.feed * dt / fineness.spacing),  // gone when an edge has crossed it at the scene's feed
      pose_(scene.pose_at(scene.depth.front())),
      deepest_(scene.depth.front()),
      state_(setup_.force->force->state_size / sizeof(std::max_align_t) + 1) {
    const kerf_tick_in in = tick_in_of(setup_, bone_.query(), dt);
    call_begin(*setup_.force, in, state_.data());
}

Felt VoxelRun::tick(const Pose& next) {
    Felt felt;
    felt.from = pose_;
    const Pose tool_from_next = inverse(pose_) * next;
    const Vec6 rate =
        make_vec6((1.0 / dt) * tool_from_next.position, (1.0 / dt) * small_rotation_vector(tool_from_next.rotation));
    felt.rate = rate[2];
    kerf_channel channels[KERF_MAX_CHANNELS];
    kerf_law law{sizeof(kerf_law), 0, channels, {}, {}};
    double lambda[KERF_MAX_CHANNELS] = {};
    bone_.place(pose_);
    felt.cost = processor_time_of([&] {
        const kerf_tick_in in = tick_in_of(setup_, bone_.query(), dt);
        if (call_resist(*setup_.force, in, state_.data(), law) != KERF_OK) law.count = 0;
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
        static_cast<void>(call_commit(*setup_.force, in, advance, state_.data(), out));
        bone_.stop_wearing();
    });
    pose_ = next;
    deepest_ = std::max(deepest_, dot(next.position - scene_.entry, scene_.along));
    return felt;
}

double VoxelRun::removed_volume() {
    if (removal_ == Removal::when_finished) {
        const Pose tool_from_body = inverse(scene_.pose_at(deepest_));
        const double radius = scene_.drill.radius(), slope = radius / scene_.drill.point_depth();
        bone_.take([&](Vec3 p) {
            const Vec3 at = tool_from_body * p;
            const double r = std::min(radius, -at.z * slope);
            return at.z < 0.0 && at.x * at.x + at.y * at.y <= r * r;
        });
    }
    return bone_.removed_volume();
}

}  // namespace kerf::chart
