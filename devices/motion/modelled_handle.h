// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "devices/motion/motion.h"
#include "kerf/device.h"

/// The handle of a device without hardware. Its limits are those of the modelled device `omega.6` of the core, with
/// ideal motors: the peak force lasts.
namespace kerf::motion {

/// Returns what such a device states.   [any] pure
/// @param name  for people
[[nodiscard]] kerf_device_facts facts_of_handle(const char* name, std::uint32_t button_count) noexcept;

/// Returns a report that has just arrived.   [haptic, nonblocking] pure
[[nodiscard]] kerf_device_state report_of(const Pose& device_from_handle, std::uint32_t buttons,
                                          std::uint64_t reports) noexcept;

}  // namespace kerf::motion
