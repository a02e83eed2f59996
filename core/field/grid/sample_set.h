// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/field/grid/brick_bits.h"

namespace kerf {

/// A set of samples, by brick. A brick with all samples is stored as its index alone.
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
    /// Adds the samples of another set. Pre: no sample is in both. A brick may then occur twice in `for_each`.
    void add(const SampleSet& others) {
        full_.insert(full_.end(), others.full_.begin(), others.full_.end());
        some_.insert(some_.end(), others.some_.begin(), others.some_.end());
    }
    /// Calls `what(brick, bits)` for each brick with samples, full ones first.
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
