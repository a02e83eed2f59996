// SPDX-License-Identifier: Apache-2.0
#include "app/window/run_screen.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace kerf::window {

RunScreen::RunScreen(run::ViewedRun& run) : run_(&run), renderer_(run.scene()) {
    if (is_software_renderer()) renderer_name_ = "software renderer";
}

// ---- input --------------------------------------------------------------------------------------------------------

void RunScreen::take(const Input& input) {
    const bool is_left_button = input.kind == Input::Kind::button && input.code == 0;
    const bool is_on_line =
        may_rewind() && layout().has_panels && mouse_y_ > static_cast<float>(height_) - Layout::bottom;
    if (is_left_button && input.is_pressed)
        for (const TimeLink& link : links_)
            if (mouse_x_ >= link.low.x && mouse_x_ <= link.high.x && mouse_y_ >= link.low.y && mouse_y_ <= link.high.y)
                return timeline_.show_at(link.time);
    if (is_left_button && (is_scrubbing_ || (input.is_pressed && is_on_line))) {
        is_scrubbing_ = input.is_pressed;
        if (is_scrubbing_) scrub(mouse_x_);
    } else if (is_refused_pause(input)) {
        return;
    } else if (!is_led() || !lead_.take(input, lead_context())) {
        take_view(input);
    }
    if (input.kind != Input::Kind::move) return;
    mouse_x_ = input.x;
    mouse_y_ = input.y;
    if (is_scrubbing_) scrub(input.x);
}

/// Takes an input that changes the view or what is shown.
void RunScreen::take_view(const Input& input) {
    switch (input.kind) {
        case Input::Kind::key:
            if (input.is_pressed) take_key(input);
            break;
        case Input::Kind::button:
            if (input.code >= 0 && input.code < 3) is_held_[input.code] = input.is_pressed;
            break;
        case Input::Kind::move: {
            const double right = static_cast<double>(input.x - mouse_x_) / std::max(height_, 1);
            const double down = static_cast<double>(input.y - mouse_y_) / std::max(height_, 1);
            const bool is_turning = is_held_[lead_.is_left_handed() ? 0 : 1];
            if (is_turning) camera_.orbit(4.0 * right, -4.0 * down);
            if (is_held_[2]) camera_.pan(right, -down);
            is_free_ = is_free_ || is_turning || is_held_[2];
            break;
        }
        case Input::Kind::wheel:
            camera_.zoom(std::pow(0.9, static_cast<double>(input.wheel)));
            is_free_ = true;
            break;
        case Input::Kind::character:
            break;
    }
}

/// An examination has no pause.
bool RunScreen::is_refused_pause(const Input& input) const {
    return run_->scene().is_examination && is_led() && input.kind == Input::Kind::key && input.code == Input::escape;
}

/// Returns whether earlier times and the inside of bone may be shown: in an examination only after its end.
bool RunScreen::may_rewind() const { return !run_->scene().is_examination || is_over(); }

/// Returns whether the mouse leads the tool now.
bool RunScreen::is_led() const {
    return run_->is_led_by_mouse() && timeline_.is_following() && !timeline_.state().is_over;
}

LeadContext RunScreen::lead_context() const {
    const run::ViewedState& state = timeline_.state();
    LeadContext context{.camera = camera_, .world_from_tool = state.world_from_tool};
    const float tall = layout().picture_high().y - layout().picture_low().y;
    context.metres_per_pixel = camera_.height_at_target() / std::max(1.0, static_cast<double>(tall));
    if (state.tool < run_->scene().tools.size()) context.lead = run_->scene().tools[state.tool].lead_by;
    constexpr double touch = 1.0;  // [N]
    context.is_in_bone = state.tissue >= 0 || state.force > touch;
    return context;
}

void RunScreen::take_key(const Input& input) {
    const auto toggle = [](bool& flag) { flag = !flag; };
    switch (input.code) {
        case Input::f1:
            return toggle(shows_keys_);
        case Input::escape:
            shows_keys_ = false;
            return;
        case Input::f3:
            return lead_.set_left_handed(!lead_.is_left_handed());
        case Input::f2:
            return toggle(shows_values_);
        case Input::tab:
            return toggle(has_panels_);
        case Input::f12:
            takes_picture_ = true;
            return;
        case 'X':
        case 'C':
            if (may_rewind()) toggle(input.code == 'X' ? settings_.is_x_ray : settings_.is_cut_away);
            return;
        case 'Z':
            return toggle(settings_.shows_zones);
        case 'P':
            return toggle(settings_.shows_plan);
        case 'V':
            return toggle(settings_.shows_force);
        case Input::space:
            if (may_rewind()) timeline_.play(!timeline_.is_playing());
            return;
        case ',':
        case '.':
            if (may_rewind()) timeline_.step(input.code == '.' ? 1 : -1);
            return;
        case '[':
            return timeline_.change_speed(0.5);
        case ']':
            return timeline_.change_speed(2.0);
        case 'F':
            return request_radiograph();
        case 'A':
            arm_ = run_->scene().arms.empty() ? 0 : (arm_ + 1) % run_->scene().arms.size();
            return;
        case 'H':
            return run_->request_help();
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

void RunScreen::request_radiograph() {
    const auto& arms = run_->scene().arms;
    if (arm_ < arms.size()) run_->request_radiograph(arms[arm_].about_head_axis, arms[arm_].tilt);
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
    const auto bone = sphere_around(surface, state);
    if (!bone) return;
    bone_ = *bone;
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
    see_step(camera_, view, steps[number], bone_);
}

// ---- drawing ------------------------------------------------------------------------------------------------------

void RunScreen::update(double wall) {
    const double passed = last_wall_ < 0.0 ? 0.0 : wall - last_wall_;
    timeline_.take(*run_, passed);
    if (!result_) result_ = run_->result();
    const run::ViewedState& state = timeline_.state();
    if (!has_seen_surface_ && timeline_.surface() != nullptr) find_box(*timeline_.surface(), state);
    const bool is_in_step = state.step < static_cast<std::int32_t>(run_->scene().steps.size());
    if (has_seen_surface_ && !is_free_ && framed_step_ != state.step && is_in_step) see_from(view_);
    pace_.show(timeline_.newest(), wall);
    if (last_wall_ >= 0.0) frame_time_ += 0.1 * (wall - last_wall_ - frame_time_);
    last_wall_ = wall;
    if (!run_->is_led_by_mouse()) return;
    constexpr double longest = 0.1;  // [s] after a pause of the machine
    if (is_led()) lead_.pass(std::min(passed, longest), lead_context());
    run_->lead(lead_.totals());
}

void RunScreen::draw(int width, int height, double wall) {
    update(wall);
    if (width < 1 || height < 1) return;
    width_ = width;
    height_ = height;
    const run::ViewedState& state = timeline_.state();
    renderer_.show(timeline_.surface(), state);
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

RadiographModel RunScreen::radiograph_model() {
    const auto shown = timeline_.radiograph();
    radiograph_.show(shown);
    const auto& arms = run_->scene().arms;
    const bool is_taking = arm_ < arms.size() && !run_->duration() && !timeline_.state().is_over;
    return {.radiograph = shown, .texture = radiograph_.name(), .arm = is_taking ? arms[arm_].words : ""};
}

void RunScreen::paint(const Layout& layout) {
    const PanelModel model{.scene = &run_->scene(),
                           .state = &timeline_.state(),
                           .timeline = &timeline_,
                           .duration = run_->duration(),
                           .result = &result_,
                           .radiograph = radiograph_model(),
                           .next_action = run_->next_action(),
                           .renderer = renderer_name_,
                           .exit_hint = exit_hint_,
                           .real_time_factor = pace_.value(),
                           .frame_time = frame_time_,
                           .lead = run_->is_led_by_mouse() ? &lead_ : nullptr,
                           .shows_keys = shows_keys_,
                           .shows_values = shows_values_,
                           .triangles = renderer_.triangles()};
    gui_.draw(width_, height_, [&](const Fonts& fonts) {
        links_ = paint_panels(model, layout, fonts);
        if (is_led()) paint_push(layout, fonts);
    });
}

/// Paints a ring around the tip that fills with the force on the hand: it replaces the feel of a device.
void RunScreen::paint_push(const Layout& layout, const Fonts& /*fonts*/) const {
    const run::ViewedState& state = timeline_.state();
    const ImVec2 low = layout.picture_low(), high = layout.picture_high();
    const double wide = static_cast<double>(high.x - low.x), tall = static_cast<double>(high.y - low.y);
    const glm::vec4 clip = camera_.clip_from_view(wide / std::max(1.0, tall)) * camera_.view_from_world() *
                           glm::vec4(single(state.world_from_tool.position), 1.0f);
    if (clip.w <= 0.0f) return;
    const ImVec2 tip{low.x + (0.5f + 0.5f * clip.x / clip.w) * (high.x - low.x),
                     low.y + (0.5f - 0.5f * clip.y / clip.w) * (high.y - low.y)};
    constexpr double full = 60.0;  // [N]
    constexpr float radius = 22.0f, turn = 6.2831853f, top = -1.5707963f;
    const double fraction = std::clamp(state.hand_force / full, 0.0, 1.0);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddCircle(tip, radius, theme::line, 48, 1.5f);
    if (fraction < 0.01) return;
    list.PathArcTo(tip, radius, top, top + turn * static_cast<float>(fraction), 48);
    list.PathStroke(fraction > 0.8 ? theme::bad : fraction > 0.5 ? theme::limit : theme::modelled, 0, 4.0f);
}

}  // namespace kerf::window
