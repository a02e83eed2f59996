// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/papers/printed_loop.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/plugin/plugin_call.h"

namespace kerf::papers {

PrintedLoop::PrintedLoop(const BoneBlock& block, const Grid& grid, const ToolSetup& setup, const Pose& start,
                         double period)
    : setup_(setup),
      bone_{block, grid, start},
      period_(period),
      state_(setup.force->force->state_size / sizeof(std::max_align_t) + 1),
      signals_(KERF_MAX_SIGNALS) {
    const kerf_bone_query bone = query();
    const kerf_tick_in in = tick_in_of(setup_, bone, period_);
    call_begin(*setup_.force, in, state_.data());
}

kerf_bone_query PrintedLoop::query() const noexcept {
    return {sizeof(kerf_bone_query),
            bone_.block.shell > 0.0 ? 2u : 1u,
            0.0,
            &sample,
            &nearest,
            nullptr,
            reinterpret_cast<const kerf_bone*>(&bone_)};
}

void PrintedLoop::sample(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count, const kerf_vec3*,
                         std::uint32_t, kerf_bone_sample* out) {
    const auto& [block, grid, pose] = *reinterpret_cast<const Bone*>(bone);
    const Vec3 x = rotate(pose.rotation, {1, 0, 0}), y = rotate(pose.rotation, {0, 1, 0}),
               z = rotate(pose.rotation, {0, 0, 1});
    const double spacing = grid.spacing;
    const auto centre = [spacing](double at, double first) {
        return first + std::floor((at - first) / spacing + 0.5) * spacing;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        out[i] = kerf_bone_sample{};
        out[i].body = -1;
        const Vec3 p = pose.position + points[i].x * x + points[i].y * y + points[i].z * z;
        if (p.z > spacing) continue;  // most of them: all that the drill has above the face
        const Vec3 at{centre(p.x, grid.origin.x), centre(p.y, grid.origin.y), centre(p.z, grid.origin.z)};
        if (std::max(std::abs(at.x), std::abs(at.y)) > 0.5 * block.width || at.z > 0.0 || at.z < -block.thickness)
            continue;
        const bool is_inner = block.shell > 0.0 && at.z < -block.shell;
        out[i].body = 0;
        out[i].engagement = out[i].weight[is_inner ? 1 : 0] = 1.0;
        out[i].density[0] = block.density;
        out[i].density[1] = block.inner;
    }
}

/// Its laws ask about points in bone alone.
void PrintedLoop::nearest(const kerf_bone*, const kerf_vec3*, std::uint32_t count, kerf_surface_point* out) {
    for (std::uint32_t i = 0; i < count; ++i) {
        out[i] = kerf_surface_point{};
        out[i].body = -1;
    }
}

void PrintedLoop::go(const Pose& next) {
    const kerf_bone_query bone = query();
    kerf_tick_in in = tick_in_of(setup_, bone, period_);
    in.tick = tick_++;
    kerf_channel channels[KERF_MAX_CHANNELS];
    kerf_law law{sizeof(kerf_law), 0, channels, {}, {}};
    const bool is_sound = call_resist(*setup_.force, in, state_.data(), law) == KERF_OK;
    for (std::size_t i = 0; i < 6; ++i) wrench_[i] = is_sound ? law.wrench[i] : std::nan("");

    const Pose tool_from_next = inverse(bone_.pose) * next;
    kerf_advance advance{};
    advance.size = sizeof advance;
    const Vec6 rate = make_vec6((1.0 / period_) * tool_from_next.position,
                                (1.0 / period_) * small_rotation_vector(tool_from_next.rotation));
    std::copy(rate.begin(), rate.end(), advance.rate);
    if (is_sound) std::copy(std::begin(law.wrench), std::end(law.wrench), advance.following);
    advance.channel = channels;
    advance.note = law.note;
    kerf_action actions[KERF_MAX_ACTIONS];
    kerf_commit_out out{sizeof(kerf_commit_out), 0, actions, signals_.data(), nullptr, 0, 0};
    static_cast<void>(call_commit(*setup_.force, in, advance, state_.data(), out));
    bone_.pose = next;
}

}  // namespace kerf::papers
