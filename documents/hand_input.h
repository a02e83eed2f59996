// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kerf::documents {

/// What a hand asks for besides moving the handle. A run records it, so that a replay asks for the same.
struct HandInput {
    enum class Kind { drive, insert, place, undo, redo, remove, fuse, subtract, release, regrip, pause, image, assist };
    Kind kind = Kind::drive;
    // `pause` is only recorded: no time passes until the hand continues. `assist` requests help with the running step.
    std::string id{};  ///< of a drive channel of the tool in hand, or of an implant
    /// What it is set to [SI]; of `regrip` 1: the hand lets the tool go about its shaft, 0: takes hold; of `image` the
    /// angle of the C-arm about the head's axis [rad].
    double value = 0.0;
    double tilt = 0.0;  ///< [rad] of the C-arm, of `image`
};

/// As it is recorded: `jaws 1`, `insert:plate`, `place:plate`, `regrip:1`, `image:0 0`, `undo`. Reading it gives the
/// same again, to the bit. [any]
[[nodiscard]] std::string text_of(const HandInput& input);
[[nodiscard]] std::optional<HandInput> hand_input(std::string_view text);

}  // namespace kerf::documents
