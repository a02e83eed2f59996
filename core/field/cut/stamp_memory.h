// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/field/cut/tool_solid.h"

namespace kerf {

/// The last solids that a field was raised to, and where they stood: cells of it remember by their numbers what they
/// were compared with last, so that a stamp need not look again at what cannot have changed.
class StampMemory {
public:
    struct Stamped {
        std::uint32_t number = 0;  ///< 0: none
        std::uint64_t solid = 0;   ///< its shape
        Pose tool_from_body = identity_pose();
    };

    /// The number of one more. Numbers are not given twice.   [haptic, nonblocking]
    std::uint32_t add(const ToolSolid& solid, const Pose& tool_from_body) noexcept {
        const std::uint32_t number = ++last_;
        stamped_[number % stamped_.size()] = {number, solid.shape_hash(), tool_from_body};
        return number;
    }
    /// Null: it is too long ago.   [haptic, nonblocking]
    [[nodiscard]] const Stamped* find(std::uint32_t number) const noexcept {
        const Stamped& stamped = stamped_[number % stamped_.size()];
        return number != 0 && stamped.number == number ? &stamped : nullptr;
    }

private:
    std::array<Stamped, 256> stamped_{};
    std::uint32_t last_ = 0;
};

}  // namespace kerf
