// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kerf/plugin.hpp"
#include "screw_thread.h"

namespace kerf::implant {

/// How wide the hole was that a tool goes into, before its core went through: measured ahead of the tip, kept by depth.
/// Bone presses on a core by how much wider it is than that.
class HoleBefore {
public:
    /// Measures the hole around the axis, a little ahead of the tip, where no place so deep has been measured yet.
    /// Deep in bone the hole is as narrow as can be known there. A tool that was withdrawn forgets it.
    /// @param along  [m] by which the tip moved along the axis in this tick
    void measure(const ScrewThread& thread, const BoneQuery& bone, double along) noexcept;
    /// Returns the radius of the hole at `z` ≤ 0 of the tool [m]; 0: there was none that is known.
    [[nodiscard]] double radius_at(double z) const noexcept;

private:
    static constexpr int most = 256;
    static constexpr double step = 0.4e-3;  ///< [m] of depth that a place stands for

    [[nodiscard]] static int place_of(double depth) noexcept;

    double depth_ = 0.0;  ///< [m] of the place ahead of the tip, since the first place was measured
    int known_ = 0;
    std::array<float, most> radius_{};  ///< [m]
};

}  // namespace kerf::implant
