// SPDX-License-Identifier: Apache-2.0
#include "run/live/loop_link.h"

#include <bit>

#include "core/field/fnv1a.h"

namespace kerf::run {

std::uint64_t bits_of(const TickResult& result) noexcept {
    Fnv1a hash;
    const auto add = [&](double value) { hash.add_bytes(std::bit_cast<std::uint64_t>(value), sizeof value); };
    for (const double component : result.command.wrench) add(component);
    const Pose& pose = result.world_from_tool;
    for (const double component : {pose.position.x, pose.position.y, pose.position.z, pose.rotation.w, pose.rotation.x,
                                   pose.rotation.y, pose.rotation.z})
        add(component);
    return hash.value();
}

}  // namespace kerf::run
