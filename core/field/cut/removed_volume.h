// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/field/cut/cut_field.h"

namespace kerf {

/// Volume of removed bone by material, updated brick by brick.
class RemovedVolume {
public:
    explicit RemovedVolume(const Body& body) : body_(&body), per_brick_(body.grid().brick_count()) {}

    /// Recounts the bricks of `cut.take_changed()`.   [worker]
    void update(CutField& cut) { update(cut, cut.take_changed()); }
    /// Recounts the bricks with the indices `changed`.   [worker]
    void update(const CutField& cut, std::span<const std::size_t> changed);
    /// Starts the count for a separated piece: what `cut` has removed so far belongs to other pieces and does not
    /// count.   [worker]
    void reset_baseline(const CutField& cut);

    /// Returns the removed volume of material `m` [m³].
    [[nodiscard]] double of_material(std::size_t m) const noexcept { return total_[m]; }
    [[nodiscard]] double total() const noexcept;

private:
    [[nodiscard]] std::array<float, KERF_MAX_TISSUES> removed_voxels(const CutField& cut,
                                                                     std::size_t brick) const noexcept;

    const Body* body_;
    std::vector<std::array<float, KERF_MAX_TISSUES>> per_brick_;  ///< [voxels]
    std::array<double, KERF_MAX_TISSUES> total_{};
};

/// Returns the volume of bone [m³] that remains in the body's region. Voxels partly in bone count by their fraction.
/// [worker] pure.
[[nodiscard]] double bone_volume(const Body& body, const CutField& cut) noexcept;

}  // namespace kerf
