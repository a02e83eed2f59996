// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kerf/plugin.hpp"
#include "screw_thread.h"

namespace kerf::implant {

/// The width of the hole before the tool's core entered it. It is measured ahead of the tip and stored by depth. The
/// pressure on the core depends on the difference in width.
class HoleBefore {
public:
    /// Measures the hole around the axis, a little ahead of the tip, at depths not measured before. Deep in bone, with
    /// no wall in reach, the hole gets the smallest width that the field can resolve. A withdrawn tool clears all
    /// measurements.
    /// @param along  [m] motion of the tip along the axis in this tick
    void measure(const ScrewThread& thread, const BoneQuery& bone, double along) noexcept;
    /// Returns the radius of the hole at `z` ≤ 0 of the tool [m]; 0 if no hole is known.
    [[nodiscard]] double radius_at(double z) const noexcept;

private:
    static constexpr int max_entries = 256;
    static constexpr double step = 0.4e-3;  ///< [m] depth per entry

    [[nodiscard]] static int index_of(double depth) noexcept;

    double depth_ = 0.0;  ///< [m] depth of the point ahead of the tip since the first entry
    int known_ = 0;
    std::array<float, max_entries> radius_{};  ///< [m]
};

}  // namespace kerf::implant
