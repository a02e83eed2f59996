// SPDX-License-Identifier: Apache-2.0
#include "run/next_actions.h"

#include <utility>

#include "run/hand_inputs.h"

namespace kerf::run {

NextActions::NextActions(const documents::Rehearsal& rehearsal) {
    for (const documents::Waypoint& waypoint : rehearsal.path) {
        std::vector<documents::HandInput> inputs = waypoint.inputs;
        std::erase_if(inputs, [](const documents::HandInput& input) { return is_passive(input.kind); });
        if (!inputs.empty()) actions_.push_back({waypoint.step, std::move(inputs)});
    }
}

std::size_t NextActions::find(std::size_t step) const noexcept {
    std::size_t at = next_;
    while (at < actions_.size() && actions_[at].step < step) ++at;
    return at < actions_.size() && actions_[at].step == step ? at : actions_.size();
}

std::optional<std::size_t> NextActions::take(std::size_t step) noexcept {
    const std::size_t at = find(step);
    if (at == actions_.size()) return std::nullopt;
    next_ = at + 1;
    return at;
}

void NextActions::follow(std::size_t step, const documents::HandInput& input) noexcept {
    const std::size_t at = find(step);
    if (at == actions_.size()) return;
    const documents::HandInput& first = actions_[at].inputs.front();
    if (first.kind == input.kind && first.id == input.id && first.value == input.value) next_ = at + 1;
}

std::string NextActions::words(std::size_t step) const {
    const std::size_t at = find(step);
    std::string text;
    if (at < actions_.size())
        for (const documents::HandInput& input : actions_[at].inputs)
            text += (text.empty() ? "" : ", ") + documents::text_of(input);
    return text;
}

}  // namespace kerf::run
