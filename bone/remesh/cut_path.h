// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/field/cut/cut_field.h"
#include "core/field/cut/tool_solid.h"

namespace kerf::bone {

/// A straight stretch of a tool's path: the solid moves from one pose to another.
struct CutStretch {
    Pose from{}, to{};  ///< body_from_tool
    std::uint16_t solid = 0;
};

/// Joins records into straight stretches: every point of the solid stays within `tolerance` [m] of its recorded
/// position. Records must be in order. A new stretch starts where the path turns back, where a record does not continue
/// the previous one, and at a turn that the hull of both ends would not cover to twice the tolerance.   [any] pure.
/// @param solids  indexed by the records' numbers
[[nodiscard]] std::vector<CutStretch> stretches_of(const std::vector<CutRecord>& records,
                                                   const std::vector<const ToolSolid*>& solids, double tolerance);

/// Joins records one by one, by the same rules; no stretch is longer than `longest`.   [worker]
class StretchJoiner {
public:
    /// @param longest  [m] largest motion of a point of the solid on one stretch, unless one record is longer
    StretchJoiner(std::vector<const ToolSolid*> solids, double tolerance, double longest)
        : solids_(std::move(solids)), tolerance_(tolerance), longest_(longest) {}

    /// Adds a record. Returns the stretch that ended before it, if any.
    std::optional<CutStretch> push(const CutRecord& record);
    /// Returns the unfinished stretch.
    [[nodiscard]] std::optional<CutStretch> open() const;
    /// Ends the unfinished stretch and returns it.
    std::optional<CutStretch> end();

private:
    std::vector<const ToolSolid*> solids_;
    double tolerance_, longest_;
    std::vector<CutRecord> open_;
};

}  // namespace kerf::bone
