// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "app/window/gl_objects.h"
#include "app/window/pixels.h"
#include "run/view/viewed_run.h"

/// A slice of the bone as a picture: tissues by colour, lines of equal distance to the surface.
namespace kerf::window {

/// Returns the picture of a slice, three pixels a sample, rows from the top. The surface is a bright line, and each
/// multiple of `interval` [m] a dim one. Beyond the slice's reach there is none.   [any] pure
[[nodiscard]] Pixels slice_picture(const run::ViewedSlice& slice, std::span<const run::ViewedTissue> tissues,
                                   double interval);

/// The picture of a slice on the graphics card. Pre: a context of OpenGL 3.3 is current.
class SliceTexture {
public:
    /// Copies a slice's picture, unless it is the last one. Null: there is none.
    void show(const std::shared_ptr<const run::ViewedSlice>& slice, std::span<const run::ViewedTissue> tissues,
              double interval);
    /// Returns the name of the texture; 0: there is no picture.
    [[nodiscard]] GLuint name() const noexcept { return shown_ != nullptr ? texture_.get() : 0; }

private:
    GlTexture texture_;
    std::shared_ptr<const run::ViewedSlice> shown_;
};

}  // namespace kerf::window
