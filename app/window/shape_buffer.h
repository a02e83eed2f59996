// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/window/gl_objects.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// A shape that does not change, such as a tool.
class ShapeBuffer {
public:
    explicit ShapeBuffer(const run::ViewedMesh& mesh);
    /// Draws it with the program in use.
    void draw() const;
    [[nodiscard]] bool is_empty() const noexcept { return count_ == 0; }

private:
    GlVertexArray array_;
    GlBuffer vertices_, indices_;
    GLsizei count_ = 0;
};

/// Returns a round bar from `from` to `to`.
[[nodiscard]] run::ViewedMesh bar(Vec3 from, Vec3 to, double radius);

/// Returns a round plate with its centre at `at`.
[[nodiscard]] run::ViewedMesh disc(Vec3 at, Vec3 normal, double radius);

}  // namespace kerf::window
