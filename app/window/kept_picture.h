// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "app/window/gl_objects.h"
#include "app/window/scene_renderer.h"

namespace kerf::window {

/// A picture as it was drawn last. To draw bone costs 30 ms on a software renderer, to copy the picture 0.1 ms.
/// Pre: a context of OpenGL 3.3 is current.
class KeptPicture {
public:
    /// Makes `show` draw the picture anew.
    void expire() noexcept { is_old_ = true; }
    /// Copies the picture into a rectangle of the bound framebuffer. If it is old or has another size, it is drawn
    /// first.
    /// @param draw  draws into a rectangle of the bound framebuffer
    void show(const Rectangle& where, const std::function<void(const Rectangle&)>& draw);

private:
    void make(int width, int height);

    int width_ = 0, height_ = 0;
    GlFramebuffer framebuffer_;
    GlTexture colour_, depth_;
    bool is_old_ = true;
};

}  // namespace kerf::window
