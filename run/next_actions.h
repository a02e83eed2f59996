// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "documents/hand_input.h"
#include "documents/procedure.h"

namespace kerf::run {

/// The actions of a procedure's steps, such as inserting a plate or closing jaws: those of a rehearsal, in its order.
/// One button of a device carries them out one after the other.
class NextActions {
public:
    explicit NextActions(const documents::Rehearsal& rehearsal);

    /// Returns the index of the next action of a step, and selects the one after it. No value: the step has no more.
    /// [haptic, nonblocking]
    [[nodiscard]] std::optional<std::size_t> take(std::size_t step) noexcept;
    /// Selects the action after this one.
    void took(std::size_t action) noexcept { next_ = action + 1; }
    /// Selects the action after the next one of a step, if that begins with this input.   [haptic, nonblocking]
    void follow(std::size_t step, const documents::HandInput& input) noexcept;
    /// Returns the inputs of an action.
    [[nodiscard]] const std::vector<documents::HandInput>& inputs(std::size_t action) const noexcept {
        return actions_[action].inputs;
    }
    /// Returns the next action of a step in words; empty: the step has no more.
    [[nodiscard]] std::string words(std::size_t step) const;

private:
    struct Action {
        std::size_t step;
        std::vector<documents::HandInput> inputs;
    };
    [[nodiscard]] std::size_t find(std::size_t step) const noexcept;
    std::vector<Action> actions_;
    std::size_t next_ = 0;  ///< actions before this one were taken or belong to earlier steps
};

}  // namespace kerf::run
