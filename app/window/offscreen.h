// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "app/window/gl_objects.h"

namespace kerf::window {

/// A picture in memory with a context of OpenGL 3.3, made by EGL without a display.   [main]
class Offscreen {
public:
    /// Returns null with the reason in `error`.
    [[nodiscard]] static std::unique_ptr<Offscreen> open(int width, int height, std::string& error);
    ~Offscreen();
    Offscreen(const Offscreen&) = delete;
    Offscreen& operator=(const Offscreen&) = delete;

private:
    Offscreen(void* display, void* context) : display_(display), context_(context) {}
    void make_picture(int width, int height);

    void *display_, *context_;
    struct Picture {
        GlFramebuffer framebuffer;
        GlTexture colour, depth;
    };
    std::unique_ptr<Picture> picture_;
};

}  // namespace kerf::window
