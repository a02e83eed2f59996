// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace kerf {

/// Pixels, row by row from the top, red, green and blue of each.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    Picture(int columns, int rows)
        : width(columns), height(rows), rgb(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
};

/// The bytes of a PNG file, without any text or time in it.   [any]
[[nodiscard]] std::string png_of(const Picture& picture);

/// The same for an <img> or <image>: `data:image/png;base64,…`.   [any]
[[nodiscard]] std::string png_link(const Picture& picture);

}  // namespace kerf
