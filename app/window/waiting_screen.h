// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/window/gui.h"

namespace kerf::window {

/// A bar that shows how far some work is. Pre: a context of OpenGL 3.3 is current.
class WaitingScreen {
public:
    /// @param fraction  of the work that is done, 0 … 1 [–]
    void draw(int width, int height, const std::string& what, double fraction);

private:
    Gui gui_;
};

}  // namespace kerf::window
