// SPDX-License-Identifier: Apache-2.0
#include "run/live/loop_link.h"

#include <bit>

namespace kerf::run {

std::uint64_t bits_of(const TickResult& result) noexcept {
    std::uint64_t bits = 0xcbf29ce484222325ull;
    const auto add = [&](double value) {
        bits = (bits ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3ull;
        bits ^= bits >> 32;  // so that a sign counts in all bits
    };
    for (const double component : result.command.wrench) add(component);
    const Pose& pose = result.world_from_tool;
    for (const double component : {pose.position.x, pose.position.y, pose.position.z, pose.rotation.w, pose.rotation.x,
                                   pose.rotation.y, pose.rotation.z})
        add(component);
    return bits;
}

}  // namespace kerf::run
