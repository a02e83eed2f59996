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
#include "core/plugin/law_memory.h"

namespace kerf {

/// The evaluated law at one pose: the plugin's channels, then the host's own walls.
struct EvaluatedLaw {
    std::array<kerf_channel, max_balance_channels> channel{};
    std::uint32_t count = 0;                            ///< number of channels in use
    std::uint32_t law_count = 0;                        ///< number of these from the plugin's law; they come first
    Vec6 wrench{};                                      ///< of the law, in addition to its channels, tool frame
    std::array<unsigned char, KERF_NOTE_BYTES> note{};  ///< passed by the plugin's `resist` to its `commit`
    bool is_at_region_wall = false;
    int metal_channel = -1;  ///< index of the channel of a body that cannot be cut; −1: none within 0.3 mm

    [[nodiscard]] std::span<const kerf_channel> channels() const noexcept { return {channel.data(), count}; }
};

/// The tool's pose and outline, and the bodies and walls around it.
struct Surroundings {
    const BodiesView& view;
    std::span<const std::unique_ptr<LiveBody>> bodies;
    HeldBody& held;
    const std::optional<Guide>& guide;
    const ToolOutline& outline;
    const Pose& world_from_tool;
};

/// Evaluates the law at the tool's pose and adds the contact channels of region, metal, sleeve and held body. Returns
/// the law's fault, or `What::none` if it is sound. With a fault, `result` has no channels. Adds the duration of the
/// plugin's call to `times`. `memory` has the state. `is_repeated`: calls the plugin twice, and compares the two laws.
/// [haptic, nonblocking]
[[nodiscard]] LawFault evaluate_law(const kerf_component& force, const kerf_tick_in& in, LawMemory& memory,
                                    const Surroundings& around, CallTimes& times, bool is_repeated,
                                    EvaluatedLaw& result) noexcept;

/// Returns the fault of a call of `commit` that returned `status` and wrote to `memory`, or `What::none`.
/// [haptic, nonblocking] after the call, on its thread
[[nodiscard]] LawFault fault_of_commit(const kerf_component& force, kerf_status status, LawMemory& memory) noexcept;

}  // namespace kerf
