// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/field/cut/cut_field.h"

namespace kerf {

/// Volume of bone gone, by tissue, kept up to date brick by brick.
class RemovedVolume {
public:
    explicit RemovedVolume(const Body& body) : body_(&body), per_brick_(body.grid().brick_count()) {}

    /// Recounts the bricks that changed since the last call.   [worker]
    void update(CutField& cut) { update(cut, cut.take_changed()); }
    /// The same, told which.
    void update(const CutField& cut, std::span<const std::size_t> changed);
    /// What is gone in `cut` and was not before is another piece's: from now on only what is cut from this one is
    /// counted.   [worker]
    void go_on_with(const CutField& cut);

    /// [m³] of material `m`.
    [[nodiscard]] double of_material(std::size_t m) const noexcept { return total_[m]; }
    [[nodiscard]] double total() const noexcept;

private:
    [[nodiscard]] std::array<float, KERF_MAX_TISSUES> gone_in(const CutField& cut, std::size_t brick) const noexcept;

    const Body* body_;
    std::vector<std::array<float, KERF_MAX_TISSUES>> per_brick_;  ///< [voxels]
    std::array<double, KERF_MAX_TISSUES> total_{};
};

/// [m³] of bone that a cut leaves in the body's region, partial voxels counted by their share.   [worker] pure.
[[nodiscard]] double bone_volume(const Body& body, const CutField& cut) noexcept;

}  // namespace kerf
