// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace kerf::window {

/// Pixels, row by row from the top, red, green and blue of each.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb{};
};

/// Returns what was drawn into the bound framebuffer. Pre: a context of OpenGL 3.3 is current.
[[nodiscard]] Pixels read_pixels(int width, int height);

}  // namespace kerf::window
