// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/evaluate_law.h"
#include "core/haptics/loop/loop_bodies.h"

namespace kerf {

/// A point of the tool that cuts nothing, lies in uncut bone, and is resisted by no channel of the law.
struct Unresisted {
    Vec3 point{};        ///< tool frame
    double depth = 0.0;  ///< [m] below the surface; a lower bound, because stored distances are clamped
};

/// Finds parts of the tool that pass through bone because the law has no channel there. The user feels nothing of it,
/// so it is reported to the law's author.
class UnresistedWatch {
public:
    /// Checks the tool after a tick, in one tick of sixteen. Returns true if an unresisted point reaches the limit: the
    /// larger of 1 mm and two voxels, but at most 3.6 voxels. Then returns false until no such point is deeper than
    /// half of the limit. [haptic, nonblocking]
    [[nodiscard]] bool check(const Motion& motion, const EvaluatedLaw& law, const LoopBodies& bodies,
                             const ToolNow& tool, double spacing) noexcept;
    /// Returns the deepest point of the check that last returned true. Valid until the next check.
    [[nodiscard]] const Unresisted& last() const noexcept { return last_; }

private:
    Unresisted last_;
    bool is_reported_ = false;  ///< reported, and not yet resisted again
};

}  // namespace kerf
