// SPDX-License-Identifier: Apache-2.0
// A drill fed by hand through a shell into cancellous bone and out again, once with each kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/field/fnv1a.h"
#include "tests/support/drill_rig.h"
#include "tests/support/drilled_block.h"
#include "tests/support/rig.h"
#include "tests/support/with_kernel.h"

namespace kerf {
namespace {

using namespace literals;

struct Outcome {
    std::uint64_t felt = 0, cut = 0;  ///< hashes: every tick's pose and wrench; the final cut
    double deepest = 0.0, max_thrust = 0.0;
};

void add_bits(Fnv1a& hash, double v) {
    std::uint64_t bits;
    std::memcpy(&bits, &v, sizeof bits);
    hash.add_bytes(bits, 8);
}

Outcome drill_with(const BlockKernel& kernel) {
    const test::WithKernel with(kernel);
    test::Rig simulation(test::shelled_block({-6.0_mm, -6.0_mm, -14.0_mm}, {6.0_mm, 6.0_mm, 0}, 1.0_mm, 0.25_mm),
                         test::twist_drill(), test::at_depth(-1.0_mm, 0.05));
    Fnv1a felt;
    Outcome outcome;
    constexpr int ticks = 5000;
    for (int t = 0; t < ticks; ++t) {
        // In with a sway, half a voxel a tick for a moment, out, and in again.
        const double share = static_cast<double>(t) / ticks;
        const double depth = share < 0.6    ? 12.0_mm * share
                             : share < 0.75 ? 7.2_mm - 30.0_mm * (share - 0.6)
                                            : 2.7_mm + 24.0_mm * (share - 0.75);
        const double sway = 0.05 + 0.02 * std::sin(20.0 * share);
        const TickResult result = simulation.tick({test::at_depth(-1.0_mm + depth, sway)});
        for (const double v : result.bone_on_tool) add_bits(felt, v);
        for (const double v : result.command.wrench) add_bits(felt, v);
        add_bits(felt, result.world_from_tool.position.z);
        outcome.deepest = std::min(outcome.deepest, result.world_from_tool.position.z);
        outcome.max_thrust = std::max(outcome.max_thrust, result.thrust);
    }
    simulation.finish();
    EXPECT_TRUE(simulation.exact().same_bits(simulation.committed()));
    outcome.felt = felt.value();
    outcome.cut = simulation.exact().hash();
    return outcome;
}

TEST(WholeRun, FeelsAndCutsTheSameWithEitherKernel) {
    if (avx2_kernel() == nullptr) GTEST_SKIP() << "this machine has no AVX2: there is only the portable kernel";

    const Outcome plain = drill_with(portable_kernel()), fast = drill_with(*avx2_kernel());

    EXPECT_LT(plain.deepest, -2.0_mm) << "it drilled a hole";
    EXPECT_GT(plain.max_thrust, 1.0);
    EXPECT_EQ(plain.felt, fast.felt);
    EXPECT_EQ(plain.cut, fast.cut);
}

}  // namespace
}  // namespace kerf
