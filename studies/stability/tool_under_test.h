// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/haptics/scene/simulation.h"
#include "core/plugin/loader.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// A tool with a force of the same plugin, everything at its default.
struct ToolUnderTest {
    ToolSetup setup;
    std::string law;          ///< the force's id
    double full_depth = 0.0;  ///< [m] behind the tip: there the cutting outline has its full radius
    double radius = 0.0;      ///< [m] of the cutting outline
    double lead = 0.0;        ///< [m] of a thread, per turn; 0: it has none, and is fed instead of turned
};
/// The plugin's first tool, with its first force or the one of this id.
/// Error: there is no such plugin, or it has no tool or no such force, or the tool cannot be made.   [main]
[[nodiscard]] std::optional<ToolUnderTest> find_tool(const PluginRegistry& plugins, const std::string& plugin,
                                                     std::string& error, const std::string& force = "");

/// Where a tool's parameters have one by its id.   [any] pure.
[[nodiscard]] std::optional<std::size_t> tool_parameter(const ToolSetup& setup, const char* id) noexcept;

/// The push at which a device is looked at [N]: 5 N, or what it can hold with something to spare.
[[nodiscard]] double push_of(const DeviceRecord& device) noexcept;
/// The default gains, scaled so that this push feeds the tool into the body at 2 mm/s.   [main]
[[nodiscard]] CouplingGains gains_under_push(const DeviceRecord& device, double push, const ToolUnderTest& tool,
                                             const Body& body, int latency = 0);

inline constexpr int run_up = 600;  ///< [ticks] a motor is given to come to its speed

}  // namespace kerf::stability
