// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/field/cut/tool_solid.h"
#include "core/haptics/law/inertia.h"
#include "core/haptics/law/tool_grip.h"
#include "kerf/abi.h"

namespace kerf {

/// A tool of a plugin, with its parameters and its law: the input of all calls to the plugin.
struct ToolSetup {
    const kerf_component* tool = nullptr;
    const kerf_component* force = nullptr;
    std::vector<double> tool_parameters, force_parameters, drives;  ///< SI, declared order
    std::vector<std::uint32_t> bound;  ///< for each need of the law: index into `tool_parameters` or `drives`
    std::uint32_t held = 0;            ///< index of the tool in the law's list of tools; 0 if the law has none
};

/// Binds the law's needs to parameters and drives of the tool, and finds the tool in the law's list. Returns the reason
/// if it cannot, else an empty text.   [main]
[[nodiscard]] std::string bind_law(ToolSetup& setup);

/// Returns the law's input for a step of `dt` [s] in tick 0, with the drives of `setup` and without the tool's outline.
/// Pre: `bind_law` succeeded, and `setup` and `bone` outlive the result.   [any] nonblocking.
[[nodiscard]] kerf_tick_in tick_in_of(const ToolSetup& setup, const kerf_bone_query& bone, double dt) noexcept;

/// A tool's shape, grip and mass as the plugin describes them.
struct ToolOutline {
    ToolSolid cutting;  ///< the part that removes bone
    ToolSolid whole;    ///< the whole tool
    ToolGrip handling{.grip_z = -0.1};
    Inertia inertia{};                        ///< of tool and handpiece
    double thread_radius = 0.0;               ///< [m] outer radius of its thread; 0: it has none
    double thread_lead = 0.0;                 ///< [m] per turn
    std::uint32_t thread_count = 0;           ///< number of profile points, from the tip, of the threaded part
    std::uint32_t stay_count = 0;             ///< number of them of the part that stays in bone; 0: not an implant
    ToolSolid crest;                          ///< of a threaded tool: the cylinder around the thread
    ToolSolid staying;                        ///< of an implant: the part that stays in bone, with its head
    std::vector<kerf_profile_point> profile;  ///< of the whole tool, from the tip backwards, as the plugin returned it
    std::uint32_t cutting_first = 0, cutting_count = 0;
    std::vector<kerf_gap> gaps;  ///< parts within the cutting part that do not cut

    [[nodiscard]] bool has_thread() const noexcept { return thread_radius > 0.0; }
    [[nodiscard]] bool is_implant() const noexcept { return stay_count > 0; }
    /// Returns the outline as a law reads it. The result points into this object, which must not move and must outlive
    /// the result.   [any]
    [[nodiscard]] kerf_solid solid() const noexcept;
};
/// Gets the outline from the plugin. Returns false and sets `error` if the plugin rejects the parameters or the outline
/// is invalid.   [main]
[[nodiscard]] bool outline_of(const ToolSetup& setup, ToolOutline& out, std::string& error);

/// Returns the angle by which a tool that declares KERF_FEED_TURN turns about its axis per metre of feed [rad/m]: one
/// turn per lead of its thread, or per millimetre without a thread. Returns 0 for any other tool.   [any]
[[nodiscard]] double turn_of_feed(const ToolSetup& setup, const ToolOutline& outline) noexcept;

/// One of the available tools.
struct Tool {
    ToolSetup setup;
    ToolOutline outline;
};

}  // namespace kerf
