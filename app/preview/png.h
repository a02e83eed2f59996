// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace kerf::app {

/// Pixels, row by row from the top, red, green and blue of each.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    Picture(int columns, int rows)
        : width(columns), height(rows), rgb(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
};

/// Returns the bytes of a PNG file, without text or time.   [any]
[[nodiscard]] std::string png_of(const Picture& picture);

/// Returns the picture as a link for <img> or <image>: `data:image/png;base64,…`.   [any]
[[nodiscard]] std::string png_link(const Picture& picture);

}  // namespace kerf::app
