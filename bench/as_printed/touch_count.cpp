// SPDX-License-Identifier: Apache-2.0
#include "touch_count.h"

namespace kerf::as_printed {

namespace {

int immersed_points(const Tick& tick, const BoneQuery& bone) noexcept {
    int count = 0;
    for_each_surface_point(paper_drill(tick.tool), tick.force[TouchCount::voxel_width], tick.force[TouchCount::shank],
                           bone, [&](Vec3, Vec3, bool is_in_bone) { count += is_in_bone ? 1 : 0; });
    return count;
}

}  // namespace

void TouchCount::resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept {
    const double force = tick.force[per_point] * immersed_points(tick, bone);
    channels.push(-force * normalized(linear(state.rate)), {0, 0, 0});
}

void TouchCount::commit(const Tick& tick, const BoneQuery&, const Advance& advance, State& state,
                        std::span<double> signals, Actions& actions) noexcept {
    signals[immersed] = 0.0;
    actions.cut();
    state.advance(tick, advance);
}

}  // namespace kerf::as_printed
