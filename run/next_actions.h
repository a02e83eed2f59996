// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "documents/hand_input.h"
#include "documents/procedure.h"

namespace kerf::run {

/// The actions of a procedure's steps, such as inserting a plate or closing jaws: those of a rehearsal, in its order.
/// One button of a device carries them out one after the other.
class NextActions {
public:
    explicit NextActions(const documents::Rehearsal& rehearsal);

    /// Returns the next action of a step, and selects the one after it. Empty: the step has no more.
    [[nodiscard]] std::vector<documents::HandInput> take(std::size_t step);
    /// Returns the next action of a step in words; empty: the step has no more.   [any] also while another thread takes
    [[nodiscard]] std::string words(std::size_t step) const;

private:
    struct Action {
        std::size_t step;
        std::vector<documents::HandInput> inputs;
    };
    [[nodiscard]] std::size_t find(std::size_t step) const noexcept;
    std::vector<Action> actions_;
    std::atomic<std::size_t> next_{0};  ///< actions before this one were taken or belong to earlier steps
};

}  // namespace kerf::run
