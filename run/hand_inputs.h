// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "documents/hand_input.h"
#include "run/scene.h"

namespace kerf::run {

/// Inputs of a hand other than motion, from its rehearsal or from a record.
class HandInputs {
public:
    using Recorded =
        std::vector<std::pair<std::uint64_t, documents::HandInput>>;  ///< each with the tick before which it comes
    /// Pre: both outlive this object. `recorded`: inputs of a replayed run; else null.
    HandInputs(const HandPlan& plan, const Recorded* recorded) : plan_(&plan), recorded_(recorded) {}
    /// Returns the inputs before a tick, for a hand that has completed `legs` legs. `is_regripping`: it has released
    /// the tool about its shaft.
    [[nodiscard]] std::vector<documents::HandInput> take(std::uint64_t tick, std::size_t legs,
                                                         bool is_regripping = false);
    /// Returns whether the rehearsal has inputs after `legs` legs that were not taken yet.
    [[nodiscard]] bool is_due(std::size_t legs) const noexcept {
        return recorded_ == nullptr && next_ <= legs && legs < plan_->inputs.size() && !plan_->inputs[legs].empty();
    }

private:
    const HandPlan* plan_;
    const Recorded* recorded_;
    std::size_t next_ = 0;
    bool is_regripping_ = false;
};

/// Applies an input of the hand. Returns the reason if it cannot, else an empty text.   [main] between ticks
[[nodiscard]] std::string carry_out(const documents::HandInput& input, const Scene& scene, Simulation& simulation);

}  // namespace kerf::run
