// SPDX-License-Identifier: Apache-2.0
#include "chip_share.h"

#include "kerf/edge_law.hpp"

namespace kerf::drilling {

EvenChip::EvenChip(double feed_per_lip, double edge_depth) noexcept
    : thickness_(std::max(feed_per_lip, edge_depth)),
      edge_depth_(edge_depth),
      built_up_(built_up_at(thickness_, edge_depth)) {}

ChipFraction EvenChip::taken(double fraction, double behind) const noexcept {
    const double chip = std::max(0.0, fraction - behind / thickness_);
    return {chip, chip < 1.0 ? built_up_at(chip * thickness_, edge_depth_) / built_up_ : 1.0};
}

std::array<double, lip_count> lip_fractions(double lag, double feed) noexcept {
    if (lag <= 0.0) return {1.0, 1.0};
    const double second = feed > 0.0 ? std::max(0.0, 1.0 - 2.0 * lag / feed) : 0.0;
    return {2.0 - second, second};
}

}  // namespace kerf::drilling
