// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/haptics/law/bodies_view.h"
#include "core/haptics/law/call_times.h"
#include "core/haptics/law/guide_wall.h"
#include "core/haptics/law/held_body.h"
#include "core/haptics/law/law_fault.h"
#include "core/haptics/law/solve.h"
#include "core/haptics/law/tool.h"

namespace kerf {

/// What resists the tool at a pose: the channels of its law, then the walls of the host's own.
struct EvaluatedLaw {
    std::array<kerf_channel, most_channels> channel{};
    std::uint32_t count = 0;                            ///< of the channels in use
    std::uint32_t law_count = 0;                        ///< the first of them: those of the plugin's law
    Vec6 wrench{};                                      ///< that the law applies beside its channels, tool frame
    std::array<unsigned char, KERF_NOTE_BYTES> note{};  ///< of the law, for its commit
    bool is_at_region_wall = false;
    int metal_channel = -1;  ///< that of a body that cannot be cut; −1: none is near

    [[nodiscard]] std::span<const kerf_channel> channels() const noexcept { return {channel.data(), count}; }
};

/// What is around the tool.
struct Surroundings {
    const BodiesView& view;
    std::span<const std::unique_ptr<LiveBody>> bodies;
    HeldBody& held;
    const std::optional<Guide>& guide;
    const ToolOutline& outline;
    const Pose& world_from_tool;
};

/// Evaluates the law where the tool is and adds the walls of region, metal, sleeve and held body. Returns what is wrong
/// with the law, `What::none` if it is sound; the result is then empty. `times` gets the duration of the plugin's call.
/// [haptic, nonblocking]
[[nodiscard]] LawFault evaluate_law(const kerf_component& force, const kerf_tick_in& in, const void* state,
                                    const Surroundings& around, CallTimes& times, EvaluatedLaw& result) noexcept;

}  // namespace kerf
