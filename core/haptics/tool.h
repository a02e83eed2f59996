// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/field/tool_solid.h"
#include "core/haptics/inertia.h"
#include "kerf/abi.h"

namespace kerf {

/// A tool of a plugin, with its parameters: everything the loop needs to ask it.
struct ToolSetup {
    const kerf_component* tool = nullptr;
    const kerf_component* force = nullptr;
    std::vector<double> tool_parameters, force_parameters, drives;  ///< SI, declared order
};

/// What its law is asked with, in a step of `dt` [s]. `setup` and `bone` must outlive the answer.   [any] nonblocking.
[[nodiscard]] kerf_tick_in tick_in_of(const ToolSetup& setup, const kerf_bone_query& bone, double dt) noexcept;

/// A tool's outline as the plugin gives it.
struct ToolOutline {
    ToolSolid cutting;  ///< removes bone
    ToolSolid whole;
    double grip_z = -0.1;  ///< [m]
    Inertia inertia{};     ///< with its handpiece
};
/// Asks the plugin; on failure `error` says why.   [main]
[[nodiscard]] bool outline_of(const ToolSetup& setup, ToolOutline& out, std::string& error);

/// One of the tools at hand.
struct Tool {
    ToolSetup setup;
    ToolOutline outline;
};

}  // namespace kerf
