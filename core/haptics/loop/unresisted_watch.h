// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/evaluate_law.h"
#include "core/haptics/loop/loop_bodies.h"

namespace kerf {

/// A point of the tool that cuts nothing, lies in uncut bone, and is resisted by no channel of the law.
struct Unresisted {
    Vec3 point{};        ///< tool frame
    double depth = 0.0;  ///< [m] at least
};

/// Finds parts of the tool that pass through bone without resistance. A law without a channel there lets the tool pass:
/// its author must learn of it, because the hand does not.
class UnresistedWatch {
public:
    /// Checks the tool after a tick, in one tick of sixteen. Returns true if such a part is found for the first time
    /// since there was none.   [haptic, nonblocking]
    [[nodiscard]] bool check(const Motion& motion, const EvaluatedLaw& law, const LoopBodies& bodies,
                             const ToolNow& tool, double spacing) noexcept;
    /// Returns where and how deep the last one was.
    [[nodiscard]] const Unresisted& last() const noexcept { return last_; }

private:
    Unresisted last_;
    bool is_reported_ = false;  ///< and not yet over
};

}  // namespace kerf
