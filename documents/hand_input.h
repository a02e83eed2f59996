// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kerf::documents {

/// What a hand asks for besides moving the handle. A run records it, so that a replay asks for the same.
struct HandInput {
    enum class Kind { drive, insert, place, undo, redo, remove, fuse, subtract, release, regrip };
    Kind kind = Kind::drive;
    std::string id{};  ///< of a drive channel of the tool in hand, or of an implant
    double value =
        0.0;  ///< what it is set to [SI]; of `regrip` 1: the hand lets the tool go about its shaft, 0: takes hold
};

/// As it is recorded: `jaws 1`, `insert:plate`, `place:plate`, `regrip:1`, `undo`. Reading it gives the same again, to
/// the bit. [any]
[[nodiscard]] std::string text_of(const HandInput& input);
[[nodiscard]] std::optional<HandInput> hand_input(std::string_view text);

}  // namespace kerf::documents
