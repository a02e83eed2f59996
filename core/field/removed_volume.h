// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "core/field/cut_field.h"

namespace kerf {

/// Volume of bone gone, by tissue, kept up to date brick by brick.
class RemovedVolume {
public:
    explicit RemovedVolume(const Body& body) : body_(&body), per_brick_(body.grid().brick_count()) {}

    /// Recounts the bricks that changed since the last call.   [worker]
    void update(CutField& cut);

    /// [m³] of material `m`.
    [[nodiscard]] double of_material(std::size_t m) const noexcept { return total_[m]; }
    [[nodiscard]] double total() const noexcept;

private:
    const Body* body_;
    std::vector<std::array<float, KERF_MAX_TISSUES>> per_brick_;  ///< [voxels]
    std::array<double, KERF_MAX_TISSUES> total_{};
};

}  // namespace kerf
