// SPDX-License-Identifier: Apache-2.0
// The C table of a law: what it begins with.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <span>

#include "kerf/force.hpp"

namespace kerf {
namespace {

struct Nothing {
    static constexpr std::size_t tool_parameter_count = 2, force_parameter_count = 1, drive_count = 1, signal_count = 0;
    static void commit(const Tick&, const BoneQuery&, const Advance&, auto&, std::span<double>, Actions&) noexcept {}
};
struct Plain : Nothing {
    struct State {
        double count = 7.0;
    };
    static void resist(const Tick&, const BoneQuery&, const State&, Channels&) noexcept {}
};
struct Preparing : Nothing {
    struct State {
        double count = 7.0, tool = 0.0, force = 0.0, drive = 0.0, voxel = 0.0;
    };
    static void begin(const Tick& tick, const BoneQuery& bone, State& fresh) noexcept {
        fresh.tool = tick.tool[1];
        fresh.force = tick.force[0];
        fresh.drive = tick.drive[0];
        fresh.voxel = bone.voxel();
    }
    static void resist(const Tick&, const BoneQuery&, const State&, Channels&) noexcept {}
};
static_assert(ForceLaw<Plain> && ForceLaw<Preparing>);

struct Asked {
    double tool[2] = {1.0, 2.0}, force[1] = {3.0}, drive[1] = {4.0};
    kerf_bone_query bone{sizeof(kerf_bone_query), 1, 2.0e-3, nullptr, nullptr, nullptr};
    kerf_tick_in in{};

    Asked() {
        in.size = sizeof in;
        in.tool_params = tool;
        in.tool_param_count = 2;
        in.force_params = force;
        in.drive = drive;
        in.bone = &bone;
    }
};

template <class L>
typename L::State begun(const kerf_tick_in& in) {
    typename L::State state;
    std::memset(static_cast<void*>(&state), 0xab, sizeof state);  // whatever was there
    ForceTable<L>::begin(&in, &state);
    return state;
}

TEST(ForceTable, ALawBeginsWithItsDefaults) { EXPECT_EQ(begun<Plain>(Asked().in).count, 7.0); }

TEST(ForceTable, ALawThatPreparesIsToldWhatItIsAskedWith) {
    const Asked asked;
    const Preparing::State state = begun<Preparing>(asked.in);
    EXPECT_EQ(state.count, 7.0);
    EXPECT_EQ(state.tool, 2.0);
    EXPECT_EQ(state.force, 3.0);
    EXPECT_EQ(state.drive, 4.0);
    EXPECT_DOUBLE_EQ(state.voxel, 0.5e-3);
}

}  // namespace
}  // namespace kerf
