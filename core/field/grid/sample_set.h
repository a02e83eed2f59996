// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/field/grid/brick_bits.h"

namespace kerf {

/// Samples of some bricks. Those that are full take no bits.
class SampleSet {
public:
    void add(std::size_t brick, const BrickBits& bits) {
        if (bits.is_full())
            full_.push_back(static_cast<std::uint32_t>(brick));
        else
            some_.emplace_back(static_cast<std::uint32_t>(brick), bits);
    }
    void reserve(std::size_t full, std::size_t others) {
        full_.reserve(full);
        some_.reserve(others);
    }
    void add_full(std::size_t brick) { full_.push_back(static_cast<std::uint32_t>(brick)); }
    /// Others of the same bricks; a brick may then come twice, with other samples.
    void add(const SampleSet& others) {
        full_.insert(full_.end(), others.full_.begin(), others.full_.end());
        some_.insert(some_.end(), others.some_.begin(), others.some_.end());
    }
    /// Calls `what(brick, bits)`: the full ones first.
    template <class Do>
    void for_each(const Do& what) const {
        for (const std::uint32_t brick : full_) what(std::size_t{brick}, BrickBits::full());
        for (const auto& [brick, bits] : some_) what(std::size_t{brick}, bits);
    }

private:
    std::vector<std::uint32_t> full_;
    std::vector<std::pair<std::uint32_t, BrickBits>> some_;
};

}  // namespace kerf
