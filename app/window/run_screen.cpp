// SPDX-License-Identifier: Apache-2.0
#include "app/window/run_screen.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace kerf::window {

RunScreen::RunScreen(run::ViewedRun& run) : run_(&run), renderer_(run.scene()), inspection_(run.scene()) {
    if (is_software_renderer()) renderer_name_ = "software renderer";
}

// ---- input --------------------------------------------------------------------------------------------------------

void RunScreen::take(const Input& input) {
    const bool is_left_button = input.kind == Input::Kind::button && input.code == 0;
    const bool is_on_line =
        may_rewind() && layout().has_panels && mouse_y_ > static_cast<float>(height_) - Layout::bottom;
    if (is_left_button && input.is_pressed)
        for (const CardLink& link : links_)
            if (mouse_x_ >= link.low.x && mouse_x_ <= link.high.x && mouse_y_ >= link.low.y && mouse_y_ <= link.high.y)
                return act(link.action);
    if (is_left_button && (is_scrubbing_ || (input.is_pressed && is_on_line))) {
        is_scrubbing_ = input.is_pressed;
        if (is_scrubbing_) scrub(mouse_x_);
    } else if (is_refused_pause(input)) {
        return;
    } else if (!is_led() || !lead_.take(input, lead_context())) {
        take_view(input);
    }
    if (input.kind != Input::Kind::move) return;
    lead_.see_cursor(input.x, input.y);
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
            follows_tip_ = follows_tip_ && !is_held_[2];
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
    context.lead = lead_of(run_->scene(), state);
    constexpr double touch = 1.0;  // [N]
    context.is_in_bone = state.tissue >= 0 || state.force > touch;
    return context;
}

// ---- the card with the result -------------------------------------------------------------------------------------

void RunScreen::act(const CardAction& action) {
    using Kind = CardAction::Kind;
    if (action.kind == Kind::toggle) {
        bool& is_open = state().is_over ? is_card_open_at_end_ : is_card_open_earlier_;
        is_open = !is_open;
    } else if (action.kind == Kind::show_moment) {
        is_card_open_earlier_ = is_card_open_earlier_ || is_card_open();  // it stays open
        timeline_.show_at(action.time);
    } else {
        action_ = action;
    }
}

bool RunScreen::is_card_open() const { return state().is_over ? is_card_open_at_end_ : is_card_open_earlier_; }

/// Takes a key of the card. Returns whether it is one.
bool RunScreen::take_card_key(int key) {
    using Kind = CardAction::Kind;
    if (!is_over()) return false;
    switch (key) {
        case 'E':
            act({Kind::toggle});
            return true;
        case 'N':
            if (buttons_.has_again) act({Kind::again});
            return true;
        case 'D':
            if (buttons_.has_debrief) act({Kind::debrief, debrief_time()});
            return true;
        case 'K':
            if (buttons_.has_resume && debrief_time() > 0.0) act({Kind::resume, debrief_time()});
            return true;
        case Input::enter:
            if (buttons_.has_start_page) act({Kind::leave});
            return true;
        case Input::arrow_up:
        case Input::arrow_down:
            choose_deduction(key == Input::arrow_down ? 1 : -1);
            return true;
        default:
            return false;
    }
}

/// Shows the moment of the next or previous deduction that has one.
void RunScreen::choose_deduction(int step) {
    if (!result_) return;
    const auto count = static_cast<int>(listed_deductions(*result_));
    for (int at = deduction_ ? static_cast<int>(*deduction_) + step
                  : step > 0 ? 0
                             : count - 1;
         at >= 0 && at < count; at += step) {
        const auto number = static_cast<std::size_t>(at);
        if (result_->deductions[number].time < 0.0) continue;
        deduction_ = number;
        return act({CardAction::Kind::show_moment, result_->deductions[number].time});
    }
}

/// Returns the time at which a debrief begins: the shown one; at the end, shortly before the largest deduction [s].
double RunScreen::debrief_time() const {
    constexpr double before = 3.0;
    if (!state().is_over) return state().time;
    if (!result_ || result_->deductions.empty()) return 0.0;
    return std::max(0.0, result_->deductions.front().time - before);
}

CardModel RunScreen::card_model() const {
    const bool is_chosen = deduction_ && result_ && *deduction_ < result_->deductions.size() &&
                           std::abs(result_->deductions[*deduction_].time - state().time) < 0.02;
    return {.result = &result_,
            .buttons = buttons_,
            .is_open = is_card_open(),
            .chosen = is_chosen ? deduction_ : std::nullopt,
            .debrief_from = debrief_time()};
}

// ---- keys ---------------------------------------------------------------------------------------------------------

void RunScreen::take_key(const Input& input) {
    if (take_card_key(input.code)) return;
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
        case Input::f4:
            return inspect(next_layers(layers_));
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
        case '4':
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
    if (const auto bone = sphere_around(surface, state)) begin_view(*bone);
}

void RunScreen::begin_view(const Sphere& bone) {
    bone_ = bone;
    has_seen_surface_ = true;
    see_from(view_);
}

void RunScreen::inspect(const InspectionLayers& layers) {
    if (run_->scene().is_examination) return;
    const bool begins = !layers_.is_any() && layers.is_any();
    layers_ = layers;
    run_->request_inspection(layers.is_any());
    if (!begins) return;
    view_ = '4';
    if (has_seen_surface_) see_from('4');
}

/// Takes a view of the running step: 1 of the whole bone, 2 along the tool, 3 from the side of the tool, 4 as 3 but
/// near the tip.
void RunScreen::see_from(char view) {
    view_ = view;
    is_free_ = view == '1' || view == '4';
    follows_tip_ = view == '4';
    framed_step_ = state().step;
    const auto& steps = run_->scene().steps;
    if (steps.empty()) return;
    const auto number = static_cast<std::size_t>(
        std::clamp<std::int32_t>(state().step, 0, static_cast<std::int32_t>(steps.size()) - 1));
    see_step(camera_, view, steps[number], bone_);
    constexpr double near = 32.0;  // [voxels] around the tip
    if (follows_tip_)
        camera_.see(state().world_from_tool.position, near * run_->scene().spacing, camera_.towards(), camera_.up());
}

// ---- drawing ------------------------------------------------------------------------------------------------------

void RunScreen::update(double wall) {
    const double passed = last_wall_ < 0.0 ? 0.0 : wall - last_wall_;
    timeline_.take(*run_, passed);
    if (!result_) result_ = run_->result();
    const run::ViewedState& state = timeline_.state();
    if (!has_seen_surface_ && timeline_.surface() != nullptr) find_box(*timeline_.surface(), state);
    if (const auto& scene = run_->scene(); !has_seen_surface_ && scene.region_radius > 0.0)
        begin_view({scene.region_middle, scene.region_radius});
    const bool is_in_step = state.step < static_cast<std::int32_t>(run_->scene().steps.size());
    if (has_seen_surface_ && !is_free_ && framed_step_ != state.step && is_in_step) see_from(view_);
    if (follows_tip_) camera_.follow(state.world_from_tool.position);
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
                           .card = card_model(),
                           .radiograph = radiograph_model(),
                           .next_action = run_->next_action(),
                           .renderer = renderer_name_,
                           .real_time_factor = pace_.value(),
                           .frame_time = frame_time_,
                           .lead = run_->is_led_by_mouse() ? &lead_ : nullptr,
                           .layers = layers_,
                           .inspection = timeline_.inspection(),
                           .shows_keys = shows_keys_,
                           .shows_values = shows_values_,
                           .triangles = renderer_.triangles()};
    const ImVec2 low = layout.picture_low(), high = layout.picture_high();
    const Projection projection(camera_, low, high);
    gui_.draw(width_, height_, [&](const Fonts& fonts) {
        inspection_.paint(model.inspection, layers_, projection, low, high, fonts, *ImGui::GetBackgroundDrawList());
        links_ = paint_panels(model, layout, fonts);
        if (is_led()) paint_push(projection);
    });
}

/// Paints a ring around the tip that fills with the force on the hand: it replaces the feel of a device.
void RunScreen::paint_push(const Projection& projection) const {
    const run::ViewedState& state = timeline_.state();
    const auto at = projection.at(state.world_from_tool.position);
    if (!at) return;
    const ImVec2 tip = *at;
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
