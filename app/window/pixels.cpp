// SPDX-License-Identifier: Apache-2.0
#include "app/window/pixels.h"

#include <epoxy/gl.h>

#include <cstddef>

namespace kerf::window {

Pixels read_pixels(int width, int height) {
    Pixels pixels{width, height, {}};
    const auto row = 3 * static_cast<std::size_t>(width);
    std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
    pixels.rgb.reserve(upside_down.size());
    for (auto y = static_cast<std::size_t>(height); y-- > 0;)
        pixels.rgb.insert(pixels.rgb.end(), upside_down.begin() + static_cast<std::ptrdiff_t>(y * row),
                          upside_down.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
    return pixels;
}

}  // namespace kerf::window
