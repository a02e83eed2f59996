// SPDX-License-Identifier: Apache-2.0
#include "app/window/run_screen.h"

#include <algorithm>
#include <cmath>

namespace kerf::window {

RunScreen::RunScreen(run::ViewedRun& run) : run_(&run), renderer_(run.scene()) {
    if (is_software_renderer()) renderer_name_ = "software renderer";
}

// ---- input --------------------------------------------------------------------------------------------------------

void RunScreen::take(const Input& input) {
    switch (input.kind) {
        case Input::Kind::key:
            if (input.is_pressed) take_key(input);
            break;
        case Input::Kind::button:
            if (input.code < 0 || input.code >= 3) break;
            is_held_[input.code] = input.is_pressed;
            is_scrubbing_ = input.code == 0 && input.is_pressed && layout().has_panels &&
                            mouse_y_ > static_cast<float>(height_) - Layout::bottom;
            if (is_scrubbing_) scrub(mouse_x_);
            break;
        case Input::Kind::move: {
            const double right = static_cast<double>(input.x - mouse_x_) / std::max(height_, 1);
            const double down = static_cast<double>(input.y - mouse_y_) / std::max(height_, 1);
            if (is_held_[1]) camera_.orbit(4.0 * right, -4.0 * down);
            if (is_held_[2]) camera_.pan(right, -down);
            is_free_ = is_free_ || is_held_[1] || is_held_[2];
            mouse_x_ = input.x;
            mouse_y_ = input.y;
            if (is_scrubbing_) scrub(input.x);
            break;
        }
        case Input::Kind::wheel:
            camera_.zoom(std::pow(0.9, static_cast<double>(input.wheel)));
            is_free_ = true;
            break;
    }
}

void RunScreen::take_key(const Input& input) {
    const auto toggle = [](bool& flag) { flag = !flag; };
    switch (input.code) {
        case Input::f1:
            return toggle(shows_keys_);
        case Input::escape:
            shows_keys_ = false;
            return;
        case Input::f2:
            return toggle(shows_values_);
        case Input::tab:
            return toggle(has_panels_);
        case Input::f12:
            takes_picture_ = true;
            return;
        case 'X':
            return toggle(settings_.is_x_ray);
        case 'C':
            return toggle(settings_.is_cut_away);
        case 'Z':
            return toggle(settings_.shows_zones);
        case 'P':
            return toggle(settings_.shows_plan);
        case 'O':
            return toggle(settings_.shows_force);
        case Input::space:
            return timeline_.play(!timeline_.is_playing());
        case ',':
            return timeline_.step(-1);
        case '.':
            return timeline_.step(1);
        case '[':
            return timeline_.change_speed(0.5);
        case ']':
            return timeline_.change_speed(2.0);
        case 'L':
            return timeline_.follow();
        case '1':
        case '2':
        case '3':
            return see_from(static_cast<char>(input.code));
        default:
            return;
    }
}

/// Shows the time at a position on the time line.
void RunScreen::scrub(float x) {
    const Layout now = layout();
    const float fraction = (x - now.line_from()) / std::max(1.0f, now.line_to() - now.line_from());
    timeline_.show_at(std::clamp(static_cast<double>(fraction), 0.0, 1.0) * line_span(timeline_, run_->duration()));
}

Layout RunScreen::layout() const {
    Layout layout{static_cast<float>(width_), static_cast<float>(height_), true};
    layout.has_panels = has_panels_ && Layout::fits(layout.width, layout.height);
    return layout;
}

// ---- the view -----------------------------------------------------------------------------------------------------

void RunScreen::find_box(const run::ViewedSurface& surface, const run::ViewedState& state) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (std::size_t body = 0; body < std::min<std::size_t>(surface.bodies.size(), state.body_count); ++body)
        for (std::size_t brick = 0; brick < surface.bodies[body].patches.capacity(); ++brick) {
            const auto& patch = surface.bodies[body].patches[brick];
            if (patch == nullptr || patch->vertices.empty()) continue;
            const float* p = patch->vertices.front().position;
            const Vec3 at = state.bodies[body].world_from_body * Vec3{p[0], p[1], p[2]};
            low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
        }
    if (low.x > high.x) return;
    middle_ = 0.5 * (low + high);
    radius_ = 0.5 * length(high - low);
    has_seen_surface_ = true;
    see_from('3');
}

/// Takes a view of the running step: 1 of the whole bone, 2 along the tool, 3 from the side of the tool.
void RunScreen::see_from(char view) {
    view_ = view;
    is_free_ = view == '1';
    framed_step_ = state().step;
    const auto& steps = run_->scene().steps;
    if (steps.empty()) return;
    const auto number = static_cast<std::size_t>(
        std::clamp<std::int32_t>(state().step, 0, static_cast<std::int32_t>(steps.size()) - 1));
    const run::ViewedStep& step = steps[number];
    const Vec3 head{0, 0, 1};
    Vec3 aside = cross(step.along, head);
    aside = length(aside) > 1e-3 ? normalized(aside) : Vec3{1, 0, 0};
    const Vec3 over = cross(aside, step.along);
    const Vec3 target = step.entry + 0.15 * (middle_ - step.entry);
    if (view == '1')
        camera_.see(middle_, 1.05 * radius_, -1.0 * step.along + 0.9 * aside + 0.5 * over, head);
    else if (view == '2')
        camera_.see(step.entry, 0.45 * radius_, -1.0 * step.along, over);
    else
        camera_.see(target, 0.72 * radius_, -1.0 * step.along + 1.15 * aside + 0.75 * over, head);
}

// ---- drawing ------------------------------------------------------------------------------------------------------

void RunScreen::draw(int width, int height, double wall) {
    if (width < 1 || height < 1) return;
    width_ = width;
    height_ = height;
    timeline_.take(*run_, last_wall_ < 0.0 ? 0.0 : wall - last_wall_);
    if (!result_) result_ = run_->result();
    const run::ViewedState& state = timeline_.state();
    renderer_.show(timeline_.surface(), state);
    if (!has_seen_surface_ && timeline_.surface() != nullptr) find_box(*timeline_.surface(), state);
    const bool is_in_step = state.step < static_cast<std::int32_t>(run_->scene().steps.size());
    if (has_seen_surface_ && !is_free_ && framed_step_ != state.step && is_in_step) see_from(view_);
    pace_.show(timeline_.newest(), wall);
    if (last_wall_ >= 0.0) frame_time_ += 0.1 * (wall - last_wall_ - frame_time_);
    last_wall_ = wall;

    const Layout layout = this->layout();
    const ImVec2 low = layout.picture_low(), high = layout.picture_high();
    const Rectangle where{static_cast<int>(low.x), height - static_cast<int>(high.y), static_cast<int>(high.x - low.x),
                          static_cast<int>(high.y - low.y)};
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_SCISSOR_TEST);
    glScissor(where.x, where.y, std::max(0, where.width), std::max(0, where.height));
    renderer_.draw(state, camera_, settings_, where);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, width, height);
    paint(layout);
}

void RunScreen::paint(const Layout& layout) {
    const PanelModel model{.scene = &run_->scene(),
                           .state = &timeline_.state(),
                           .timeline = &timeline_,
                           .duration = run_->duration(),
                           .result = &result_,
                           .next_action = run_->next_action(),
                           .renderer = renderer_name_,
                           .real_time_factor = pace_.value(),
                           .frame_time = frame_time_,
                           .shows_keys = shows_keys_,
                           .shows_values = shows_values_,
                           .triangles = renderer_.triangles()};
    gui_.draw(width_, height_, [&](const Fonts& fonts) { paint_panels(model, layout, fonts); });
}

Pixels RunScreen::pixels() const {
    Pixels pixels{width_, height_, {}};
    const auto row = 3 * static_cast<std::size_t>(width_);
    std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
    pixels.rgb.reserve(upside_down.size());
    for (std::size_t y = static_cast<std::size_t>(height_); y-- > 0;)
        pixels.rgb.insert(pixels.rgb.end(), upside_down.begin() + static_cast<std::ptrdiff_t>(y * row),
                          upside_down.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
    return pixels;
}

}  // namespace kerf::window
