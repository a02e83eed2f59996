// SPDX-License-Identifier: Apache-2.0
#include "touch_count.h"

namespace kerf::as_printed {

namespace {

int immersed_points(const TouchCount& law, const PaperBit& tool, const BoneQuery& bone) noexcept {
    int count = 0;
    for_each_surface_point(tool.drill(), law.voxel_width, law.shank, bone,
                           [&](Vec3, Vec3, bool is_in_bone) { count += is_in_bone ? 1 : 0; });
    return count;
}

}  // namespace

void TouchCount::resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                        Channels& channels) const noexcept {
    const double force = per_point * immersed_points(*this, tool, bone);
    channels.push(-force * normalized(linear(state.rate)), {0, 0, 0});
}

void TouchCount::commit(const Held<PaperBit>& tool, const BoneQuery&, const Advance& advance, State& state,
                        Signals& signals, Actions& actions) const noexcept {
    signals.immersed = 0.0;
    actions.cut();
    state.advance(tool, advance);
}

}  // namespace kerf::as_printed
