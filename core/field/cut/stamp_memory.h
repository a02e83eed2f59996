// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/field/cut/tool_solid.h"

namespace kerf {

/// Ring of the last 256 stamps of a field. Each cell stores the number of the last stamp compared with it, so that a
/// stamp skips cells that cannot have changed.
class StampMemory {
public:
    struct Stamped {
        std::uint32_t number = 0;  ///< 0: none
        std::uint64_t solid = 0;   ///< hash of its shape
        Pose tool_from_body = identity_pose();
    };

    /// Adds a stamp. Returns its number, which is unique.   [haptic, nonblocking]
    std::uint32_t add(const ToolSolid& solid, const Pose& tool_from_body) noexcept {
        const std::uint32_t number = ++last_;
        stamped_[number % stamped_.size()] = {number, solid.shape_hash(), tool_from_body};
        return number;
    }
    /// Returns a stamp; null: it is no longer stored.   [haptic, nonblocking]
    [[nodiscard]] const Stamped* find(std::uint32_t number) const noexcept {
        const Stamped& stamped = stamped_[number % stamped_.size()];
        return number != 0 && stamped.number == number ? &stamped : nullptr;
    }

private:
    std::array<Stamped, 256> stamped_{};
    std::uint32_t last_ = 0;
};

}  // namespace kerf
