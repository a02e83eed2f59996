// SPDX-License-Identifier: Apache-2.0
#include "app/window/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "app/window/shaders.h"

namespace kerf::window {

namespace {

constexpr std::size_t palette_size = 16;

/// Returns an sRGB colour in the linear space of the shaders.
glm::vec3 linear_colour(int red, int green, int blue) {
    const glm::vec3 s = glm::vec3(red, green, blue) / 255.0f;
    return s * s;
}
const glm::vec3 steel = linear_colour(0xb8, 0xbd, 0xc3), titanium = linear_colour(0x9a, 0x99, 0xa4),
                forbidden = linear_colour(0xb5, 0x17, 0x9e), plan_blue = linear_colour(0x4c, 0x9b, 0xe8),
                arrow_orange = linear_colour(0x56, 0xb4, 0xe9);

}  // namespace

SceneRenderer::SceneRenderer(const run::ViewedScene& scene)
    : scene_(&scene),
      bone_(make_program(shaders::bone_vertex, shaders::bone_fragment)),
      x_ray_(make_program(shaders::x_ray_vertex, shaders::x_ray_fragment)),
      metal_(make_program(shaders::shape_vertex, shaders::metal_fragment)),
      zone_(make_program(shaders::shape_vertex, shaders::zone_fragment)),
      flat_(make_program(shaders::shape_vertex, shaders::flat_fragment)),
      background_(make_program(shaders::background_vertex, shaders::background_fragment)),
      nothing_(make_vertex_array()),
      palette_(palette_size, steel),
      arrow_(bar({0, 0, 0}, {0, 0, 1e-3}, 0.6e-3)) {
    for (std::size_t t = 0; t < std::min(scene.tissues.size(), palette_size); ++t) {
        const run::ViewedColour& colour = scene.tissues[t].colour;
        palette_[t] = linear_colour(colour.red, colour.green, colour.blue);
    }
    for (const run::ViewedTool& tool : scene.tools) {
        tools_.emplace_back(tool.mesh);
        staying_.emplace_back(tool.staying);
    }
    for (const run::ViewedMesh& implant : scene.implants) implants_.emplace_back(implant);
    for (const run::ViewedZone& zone : scene.zones) zones_.emplace_back(zone.mesh);
    for (const run::ViewedStep& step : scene.steps) {
        constexpr double before = 60e-3, radius = 0.35e-3;
        Plan plan{ShapeBuffer(bar(step.entry - before * step.along, step.entry, radius)),
                  ShapeBuffer(bar(step.entry, step.entry + step.length * step.along, radius)), std::nullopt};
        if (step.plane_normal) plan.plane.emplace(disc(step.entry, *step.plane_normal, 45e-3));
        plans_.push_back(std::move(plan));
    }
}

void SceneRenderer::show(const std::shared_ptr<const run::ViewedSurface>& surface, const run::ViewedState& state) {
    if (surface == nullptr) return;
    while (bodies_.size() < surface->bodies.size()) bodies_.push_back(std::make_unique<BoneBuffer>());
    bodies_.resize(surface->bodies.size());
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
        const Pose world_from_body = body < state.body_count ? state.bodies[body].world_from_body : identity_pose();
        bodies_[body]->show(surface->bodies[body], inverse(world_from_body) * state.world_from_tool.position);
    }
}

std::size_t SceneRenderer::triangles() const noexcept {
    std::size_t count = 0;
    for (const auto& body : bodies_) count += body->triangles();
    return count;
}

void SceneRenderer::use(const GlProgram& program, const Matrices& matrices, const Pose& world_from_body) const {
    const glm::mat4 view = matrices.view_from_world * matrix_of(world_from_body), clip = matrices.clip_from_view * view;
    glUseProgram(program.get());
    glUniformMatrix4fv(uniform(program, "clip_from_body"), 1, GL_FALSE, glm::value_ptr(clip));
    glUniformMatrix4fv(uniform(program, "view_from_body"), 1, GL_FALSE, glm::value_ptr(view));
}

void SceneRenderer::draw(const run::ViewedState& state, const Camera& camera, const ViewSettings& settings,
                         const Rectangle& where) const {
    if (where.width < 1 || where.height < 1) return;
    glViewport(where.x, where.y, where.width, where.height);
    const Matrices matrices{camera.view_from_world(),
                            camera.clip_from_view(static_cast<double>(where.width) / where.height)};
    draw_background();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_BLEND);
    draw_metal(state, matrices);
    draw_bone(state, matrices, settings);
    if (settings.shows_plan) draw_plan(state, matrices);
    if (settings.shows_zones) draw_zones(state, matrices);
    if (settings.shows_force) draw_force(state, matrices);
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(0);
    glUseProgram(0);
}

void SceneRenderer::draw_background() const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glUseProgram(background_.get());
    glBindVertexArray(nothing_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void SceneRenderer::draw_bone(const run::ViewedState& state, const Matrices& matrices,
                              const ViewSettings& settings) const {
    const GlProgram& program = settings.is_x_ray ? x_ray_ : bone_;
    if (settings.is_x_ray) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glDepthMask(GL_FALSE);
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
    }
    if (settings.is_cut_away) glDisable(GL_CULL_FACE);
    for (std::size_t body = 0; body < std::min<std::size_t>(bodies_.size(), state.body_count); ++body) {
        if (state.bodies[body].kind != run::ViewedBody::Kind::bone) continue;
        const Pose& world_from_body = state.bodies[body].world_from_body;
        use(program, matrices, world_from_body);
        glUniform3fv(uniform(program, "palette"), static_cast<GLsizei>(palette_.size()),
                     glm::value_ptr(palette_.front()));
        glUniform1f(uniform(program, "noise"), 0.10f);
        glm::vec4 plane(0, 0, 0, -1);
        if (settings.is_cut_away) {
            // Through the tool's axis, square to the eye as far as it can be.
            const Vec3 along = rotate(state.world_from_tool.rotation, {0, 0, 1});
            const glm::mat4 world_from_view = glm::inverse(matrices.view_from_world);
            const Vec3 eye{world_from_view[2][0], world_from_view[2][1], world_from_view[2][2]};
            const Vec3 across = eye - dot(eye, along) * along;
            if (length(across) > 1e-3) {
                const Vec3 normal = rotate(conjugate(world_from_body.rotation), normalized(across));
                const Vec3 at = inverse(world_from_body) * state.world_from_tool.position;
                plane = glm::vec4(single(normal), static_cast<float>(-dot(normal, at)));
                glEnable(GL_CLIP_DISTANCE0);
            }
        }
        glUniform4fv(uniform(program, "cut_plane"), 1, glm::value_ptr(plane));
        bodies_[body]->draw();
        glDisable(GL_CLIP_DISTANCE0);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

void SceneRenderer::draw_metal(const run::ViewedState& state, const Matrices& matrices) const {
    const auto draw = [&](const ShapeBuffer& shape, const Pose& pose, const glm::vec3& base) {
        use(metal_, matrices, pose);
        glUniform3fv(uniform(metal_, "base"), 1, glm::value_ptr(base));
        shape.draw();
    };
    glDisable(GL_CULL_FACE);
    if (state.is_tool_in_hand && state.tool < tools_.size()) draw(tools_[state.tool], state.world_from_tool, steel);
    for (std::size_t body = 0; body < state.body_count; ++body) {
        const run::ViewedBody& one = state.bodies[body];
        if (one.kind == run::ViewedBody::Kind::staying_part && one.shape < staying_.size())
            draw(staying_[one.shape], one.world_from_body, titanium);
        if (one.kind == run::ViewedBody::Kind::implant && one.shape < implants_.size())
            draw(implants_[one.shape], one.world_from_body, titanium);
    }
}

void SceneRenderer::draw_zones(const run::ViewedState& state, const Matrices& matrices) const {
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    glEnable(GL_POLYGON_OFFSET_FILL);  // a zone that ends on the bone's surface lies behind it
    glPolygonOffset(2.0f, 2.0f);
    for (std::size_t zone = 0; zone < zones_.size(); ++zone) {
        if (zones_[zone].is_empty() || zone >= 32 || (state.shown_zones >> zone & 1u) == 0) continue;
        const std::size_t body = zone < run::max_viewed_zones ? state.zone_body[zone] : 0;
        use(zone_, matrices, state.bodies[body].world_from_body);
        glUniform3fv(uniform(zone_, "base"), 1, glm::value_ptr(forbidden));
        zones_[zone].draw();
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

void SceneRenderer::draw_plan(const run::ViewedState& state, const Matrices& matrices) const {
    if (state.step < 0 || static_cast<std::size_t>(state.step) >= plans_.size()) return;
    if (!state.has_help || !(scene_->steps[static_cast<std::size_t>(state.step)].length > 0.0)) return;
    const Plan& plan = plans_[static_cast<std::size_t>(state.step)];
    use(flat_, matrices, identity_pose());
    glUniform3fv(uniform(flat_, "base"), 1, glm::value_ptr(plan_blue));
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    const auto opacity = [&](float value) { glUniform1f(uniform(flat_, "opacity"), value); };
    opacity(0.9f);
    plan.outside.draw();
    glDisable(GL_DEPTH_TEST);  // seen through bone
    opacity(0.45f);
    plan.inside.draw();
    glEnable(GL_DEPTH_TEST);
    if (plan.plane) {
        glDepthMask(GL_FALSE);
        opacity(0.16f);
        plan.plane->draw();
        glDepthMask(GL_TRUE);
    }
    glDisable(GL_BLEND);
}

/// Draws the force of bone on the tool as an arrow from the tip: 1 mm a newton.
void SceneRenderer::draw_force(const run::ViewedState& state, const Matrices& matrices) const {
    constexpr double shown_from = 1.0, longest = 60.0;  // [N]
    if (state.force < shown_from) return;
    const double newtons = std::min(state.force, longest);
    const Pose pose{state.world_from_tool.position, quat_between({0, 0, 1}, (1.0 / state.force) * state.force_on_tool)};
    const glm::mat4 view = matrices.view_from_world * matrix_of(pose) *
                           glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0),
                                     glm::vec4(0, 0, static_cast<float>(newtons), 0), glm::vec4(0, 0, 0, 1));
    use(flat_, matrices, pose);
    glUniformMatrix4fv(uniform(flat_, "clip_from_body"), 1, GL_FALSE, glm::value_ptr(matrices.clip_from_view * view));
    glUniformMatrix4fv(uniform(flat_, "view_from_body"), 1, GL_FALSE, glm::value_ptr(view));
    glUniform3fv(uniform(flat_, "base"), 1, glm::value_ptr(arrow_orange));
    glUniform1f(uniform(flat_, "opacity"), 0.95f);
    arrow_.draw();
}

}  // namespace kerf::window
