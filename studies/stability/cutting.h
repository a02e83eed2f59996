// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studies/stability/finding.h"
#include "studies/stability/scope.h"
#include "studies/stability/tool_under_test.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// The largest gain [N·s/m] of a sampled damper f = max(0, G v) that a push of `push` [N] does not make alternate, by
/// bisection. v is the difference of two samples.
[[nodiscard]] double largest_damper(PortSettings settings, double push);

/// S-01: a hand pushes into a block. The feed law as a damper, the plugin's law at the device's rate, and Kerf. [main]
void check_cutting(const Scope& scope, const ToolUnderTest& tool, const Report& report);

}  // namespace kerf::stability
