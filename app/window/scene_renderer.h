// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/window/bone_buffer.h"
#include "app/window/camera.h"
#include "app/window/gl_objects.h"
#include "app/window/shape_buffer.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// Switches of the picture.
struct ViewSettings {
    bool is_x_ray = false, is_cut_away = false, shows_zones = true, shows_plan = true, shows_force = true;
};

/// A rectangle of the window, in pixels from the lower left corner.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Draws the scene of a run: bone, tool, implants, zones, the plan of the step.
class SceneRenderer {
public:
    /// Compiles all programs and uploads the shapes. Throws std::runtime_error if the driver refuses.
    explicit SceneRenderer(const run::ViewedScene& scene);

    /// Uploads what has changed of a surface; it may be null. Near the tool it is drawn with all triangles, elsewhere
    /// with as many as fit a software renderer.
    void show(const std::shared_ptr<const run::ViewedSurface>& surface, const run::ViewedState& state);
    /// Draws a picture into a rectangle of the bound framebuffer.
    void draw(const run::ViewedState& state, const Camera& camera, const ViewSettings& settings,
              const Rectangle& where) const;
    [[nodiscard]] std::size_t triangles() const noexcept;

private:
    struct Matrices {
        glm::mat4 view_from_world, clip_from_view;
    };
    void use(const GlProgram& program, const Matrices& matrices, const Pose& world_from_body) const;
    void draw_background() const;
    void draw_bone(const run::ViewedState& state, const Matrices& matrices, const ViewSettings& settings) const;
    void draw_metal(const run::ViewedState& state, const Matrices& matrices) const;
    void draw_zones(const run::ViewedState& state, const Matrices& matrices) const;
    void draw_plan(const run::ViewedState& state, const Matrices& matrices) const;
    void draw_force(const run::ViewedState& state, const Matrices& matrices) const;

    const run::ViewedScene* scene_;
    GlProgram bone_, x_ray_, metal_, zone_, flat_, background_;
    GlVertexArray nothing_;
    std::vector<glm::vec3> palette_;
    std::vector<std::unique_ptr<BoneBuffer>> bodies_;
    std::vector<ShapeBuffer> tools_, staying_, implants_, zones_;
    /// The plan of a step: its axis before and in the bone, and its plane.
    struct Plan {
        ShapeBuffer outside, inside;
        std::optional<ShapeBuffer> plane;
    };
    std::vector<Plan> plans_;
    ShapeBuffer arrow_;
};

}  // namespace kerf::window
