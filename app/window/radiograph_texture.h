// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "app/window/gl_objects.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// The radiograph that a panel shows, as a grey texture. Pre: a context of OpenGL 3.3 is current.
class RadiographTexture {
public:
    /// Copies a radiograph to the graphics card, unless it is the last one. Null, or one with an error: there is none.
    void show(const std::shared_ptr<const run::ViewedRadiograph>& radiograph);
    /// Returns the name of the texture; 0: there is no picture.
    [[nodiscard]] GLuint name() const noexcept { return has_picture_ ? texture_.get() : 0; }

private:
    GlTexture texture_;
    std::shared_ptr<const run::ViewedRadiograph> shown_;
    bool has_picture_ = false;
};

}  // namespace kerf::window
