// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/haptics/law/tool.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf {

/// Returns the value of the law's signal `id`; NaN where the law has none.   [any] pure.
[[nodiscard]] inline double signal_of(const ToolSetup& setup, const double* signals, std::string_view id) noexcept {
    const kerf_force& force = *setup.force->force;
    for (std::uint32_t i = 0; i < force.signal_count; ++i)
        if (id == force.signals[i].id) return signals[i];
    return std::nan("");
}

}  // namespace kerf
