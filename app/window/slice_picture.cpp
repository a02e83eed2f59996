// SPDX-License-Identifier: Apache-2.0
#include "app/window/slice_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace kerf::window {

namespace {

constexpr int pixels_per_sample = 3;

struct Shade {
    double red = 0.0, green = 0.0, blue = 0.0;
};
constexpr Shade air{26, 31, 38}, metal{150, 158, 166}, surface_line{255, 255, 255};

Shade mixed(const Shade& from, const Shade& to, double fraction) {
    return {from.red + fraction * (to.red - from.red), from.green + fraction * (to.green - from.green),
            from.blue + fraction * (to.blue - from.blue)};
}

/// Returns the distance at a pixel [m], between the samples around it.
double distance_at(const run::ViewedSlice& slice, double column, double row) {
    const int left = std::clamp(static_cast<int>(column), 0, slice.edge - 2);
    const int low = std::clamp(static_cast<int>(row), 0, slice.edge - 2);
    const double x = std::clamp(column - left, 0.0, 1.0), y = std::clamp(row - low, 0.0, 1.0);
    const auto sample = [&](int c, int r) {
        return static_cast<double>(slice.distance[static_cast<std::size_t>(r * slice.edge + c)]);
    };
    return (1.0 - y) * ((1.0 - x) * sample(left, low) + x * sample(left + 1, low)) +
           y * ((1.0 - x) * sample(left, low + 1) + x * sample(left + 1, low + 1));
}

Shade filled(const run::ViewedSlice& slice, double column, double row, std::span<const run::ViewedTissue> tissues) {
    const int c = std::clamp(static_cast<int>(std::lround(column)), 0, slice.edge - 1);
    const int r = std::clamp(static_cast<int>(std::lround(row)), 0, slice.edge - 1);
    // NOLINTNEXTLINE(bugprone-signed-char-misuse): negative values are kinds, so the sign is meant
    const int tissue = slice.tissue[static_cast<std::size_t>(r * slice.edge + c)];
    if (tissue < -1) return metal;
    if (tissue < 0 || static_cast<std::size_t>(tissue) >= tissues.size()) return air;
    const run::ViewedColour& colour = tissues[static_cast<std::size_t>(tissue)].colour;
    return mixed(air,
                 {static_cast<double>(colour.red), static_cast<double>(colour.green), static_cast<double>(colour.blue)},
                 0.62);
}

}  // namespace

Pixels slice_picture(const run::ViewedSlice& slice, std::span<const run::ViewedTissue> tissues, double interval) {
    const int edge = slice.edge * pixels_per_sample;
    Pixels picture{edge, edge, {}};
    picture.rgb.reserve(3 * static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge));
    constexpr double size = 1.0 / pixels_per_sample;  // [samples] of a pixel
    for (int y = 0; y < edge; ++y)
        for (int x = 0; x < edge; ++x) {
            const double column = (x + 0.5) * size - 0.5, row = slice.edge - 0.5 - (y + 0.5) * size;
            const double distance = distance_at(slice, column, row);
            // By which the distance changes in a pixel: lines have the same width at any slope of the surface.
            const double pixel = std::max(1e-9, std::hypot(distance_at(slice, column + size, row) - distance,
                                                           distance_at(slice, column, row + size) - distance));
            Shade shade = filled(slice, column, row, tissues);
            constexpr double clamped = 0.98;
            const double line = interval * std::round(distance / interval);
            if (std::abs(distance) < clamped * slice.reach && line != 0.0)
                shade = mixed(shade, surface_line, 0.4 * std::clamp(1.2 - std::abs(distance - line) / pixel, 0.0, 1.0));
            shade = mixed(shade, surface_line, std::clamp(2.2 - std::abs(distance) / pixel, 0.0, 1.0));
            for (const double one : {shade.red, shade.green, shade.blue})
                picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(one)));
        }
    return picture;
}

void SliceTexture::show(const std::shared_ptr<const run::ViewedSlice>& slice,
                        std::span<const run::ViewedTissue> tissues, double interval) {
    if (slice == shown_) return;
    shown_ = slice;
    if (slice == nullptr) return;
    const Pixels picture = slice_picture(*slice, tissues, interval);
    if (texture_.get() == 0) texture_ = make_texture();
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 picture.rgb.data());
    glBindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace kerf::window
