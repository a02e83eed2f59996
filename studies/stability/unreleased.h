// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/loop/coupling.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// The same gains without the damper that slows a tool that has broken through. Where Kerf fails, findings tell what
/// the scene comes to without it: whether it is the cause.
[[nodiscard]] inline CouplingGains unreleased(CouplingGains gains) noexcept {
    gains.release_damping = 0.0;
    return gains;
}
inline constexpr const char* without_release = "without the release damper: ";

}  // namespace kerf::stability
