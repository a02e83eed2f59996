// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "documents/hand_input.h"
#include "run/scene.h"

namespace kerf {

/// What a hand asks for besides moving: as its rehearsal says, or as it was recorded.
class HandInputs {
public:
    using Recorded = std::vector<std::pair<std::uint64_t, HandInput>>;  ///< before which tick
    /// Both must outlive it. `recorded`: of a run that is replayed; else null.
    HandInputs(const HandPlan& plan, const Recorded* recorded) : plan_(&plan), recorded_(recorded) {}
    /// Before a tick, of a hand that has gone `legs` of its way and may have let the tool go about its shaft.
    [[nodiscard]] std::vector<HandInput> take(std::uint64_t tick, std::size_t legs, bool is_regripping = false);
    /// Whether a hand that has gone `legs` of its way has asked for nothing yet of what it asks there.
    [[nodiscard]] bool is_due(std::size_t legs) const noexcept {
        return recorded_ == nullptr && next_ <= legs && legs < plan_->inputs.size() && !plan_->inputs[legs].empty();
    }

private:
    const HandPlan* plan_;
    const Recorded* recorded_;
    std::size_t next_ = 0;
    bool is_regripping_ = false;
};

/// Carries out what a hand asks for. Not empty: why not.   [main] between ticks
[[nodiscard]] std::string carry_out(const HandInput& input, const Scene& scene, Simulation& simulation);

}  // namespace kerf
