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

/// Inputs other than motion of a recorded run, each with the tick before which it came, in order.
using RecordedInputs = std::vector<std::pair<std::uint64_t, documents::HandInput>>;

/// Returns whether an input takes no time: `drive` and `regrip` set the motor or the grip of the loop, and `pause` sets
/// nothing.
[[nodiscard]] constexpr bool is_immediate(documents::HandInput::Kind kind) noexcept {
    using Kind = documents::HandInput::Kind;
    return kind == Kind::drive || kind == Kind::regrip || kind == Kind::pause;
}
/// Returns whether an input changes neither bone nor forces: a loop on the clock does not learn of it.
[[nodiscard]] constexpr bool is_passive(documents::HandInput::Kind kind) noexcept {
    using Kind = documents::HandInput::Kind;
    return kind == Kind::image || kind == Kind::assist;
}
/// Carries out an immediate input at a loop. Returns false if the tool in hand has no such drive, or no thread to
/// regrip.   [haptic, nonblocking] between ticks
bool carry_out_at(HapticLoop& loop, const documents::HandInput& input) noexcept;

/// Applies an input of the hand. Returns the reason if it cannot, else an empty text.   [main] between ticks
[[nodiscard]] std::string carry_out(const documents::HandInput& input, const Scene& scene, Simulation& simulation);

}  // namespace kerf::run
