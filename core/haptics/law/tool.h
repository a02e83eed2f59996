// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/field/cut/tool_solid.h"
#include "core/haptics/law/handling.h"
#include "core/haptics/law/inertia.h"
#include "kerf/abi.h"

namespace kerf {

/// A tool of a plugin, with its parameters: everything the loop needs to ask it.
struct ToolSetup {
    const kerf_component* tool = nullptr;
    const kerf_component* force = nullptr;
    std::vector<double> tool_parameters, force_parameters, drives;  ///< SI, declared order
    std::vector<std::uint32_t> bound;  ///< of each need of the law: its index into `tool_parameters` or `drives`
    std::uint32_t held = 0;            ///< which of the law's own tools it is
};

/// Finds what the law needs in the tool, or the tool among those that the law takes. Returns why it cannot; empty when
/// it can.   [main]
[[nodiscard]] std::string bind_law(ToolSetup& setup);

/// Returns the input of the law in a step of `dt` [s], without the tool's outline. `setup` and `bone` must outlive it.
/// Pre: `bind_law` succeeded.   [any] nonblocking.
[[nodiscard]] kerf_tick_in tick_in_of(const ToolSetup& setup, const kerf_bone_query& bone, double dt) noexcept;

/// A tool's outline as the plugin gives it.
struct ToolOutline {
    ToolSolid cutting;  ///< removes bone
    ToolSolid whole;
    Handling handling{.grip_z = -0.1};
    Inertia inertia{};                        ///< with its handpiece
    double thread_radius = 0.0;               ///< [m] over its thread; 0: it has none
    double thread_lead = 0.0;                 ///< [m] in one turn
    std::uint32_t thread_count = 0;           ///< the first points of the profile, which bear the thread
    std::uint32_t stay_count = 0;             ///< the first points of the profile, which stay in bone; 0: it leaves
    ToolSolid crest;                          ///< with a thread: the cylinder over it
    ToolSolid staying;                        ///< of an implant: all that stays, with its head
    std::vector<kerf_profile_point> profile;  ///< as the plugin gave it
    std::uint32_t cutting_first = 0, cutting_count = 0;
    std::vector<kerf_gap> gaps;  ///< safe parts within what cuts

    [[nodiscard]] bool has_thread() const noexcept { return thread_radius > 0.0; }
    [[nodiscard]] bool is_implant() const noexcept { return stay_count > 0; }
    /// The outline as a law reads it. It lives as long as this and is not moved.   [any]
    [[nodiscard]] kerf_solid solid() const noexcept;
};
/// Asks the plugin; on failure `error` says why.   [main]
[[nodiscard]] bool outline_of(const ToolSetup& setup, ToolOutline& out, std::string& error);

/// How far a tool that declares KERF_FEED_TURN turns about its axis for each metre of its feed [rad/m]: once for each
/// lead of its thread; without one, once for each millimetre. 0: it is not fed by turning.   [any]
[[nodiscard]] double turn_of_feed(const ToolSetup& setup, const ToolOutline& outline) noexcept;

/// One of the tools at hand.
struct Tool {
    ToolSetup setup;
    ToolOutline outline;
};

}  // namespace kerf
