// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf::window {

/// What a user does with keyboard and mouse. Positions in pixels from the upper left corner.
struct Input {
    enum class Kind { key, button, move, wheel, character } kind = Kind::move;
    /// Keys by their character in upper case; others by this list.
    enum Key : int {
        escape = 256,
        tab,
        space,
        left_shift,
        f1,
        f2,
        f3,
        f4,
        f12,
        arrow_left,
        arrow_right,
        arrow_up,
        arrow_down,
        enter,
        backspace,
        erase,
        home,
        end
    };
    int code = 0;  ///< of a key or a character; or the number of a button: 0 left, 1 right, 2 middle
    bool is_pressed = false, has_control = false, has_shift = false;
    float x = 0.0f, y = 0.0f;
    float wheel = 0.0f;  ///< notches, upwards positive
};

}  // namespace kerf::window
