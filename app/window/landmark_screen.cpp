// SPDX-License-Identifier: Apache-2.0
#include "app/window/landmark_screen.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/window/panel_painter.h"
#include "app/window/widgets.h"
#include "app/window/window_text.h"

namespace kerf::window {

namespace {

constexpr float bottom_height = 34.0f, panel_width = 300.0f;
constexpr float click_slack = 4.0f;  // [pixel] a longer motion with the button pressed is a drag

std::string millimetres(Vec3 p) {
    const auto part = [](double metres) { return std::round(1e5 * metres) * 1e-2 + 0.0; };  // no -0.00
    return formatted("%.2f  %.2f  %.2f mm", part(p.x), part(p.y), part(p.z));
}

}  // namespace

LandmarkScreen::LandmarkScreen(LandmarkSource& source, LandmarkList& list)
    : source_(&source), list_(&list), renderer_(source.scene()) {
    set_style();
    state_.is_tool_in_hand = false;
    state_.body_count = 1;
    state_.bodies[0].kind = run::ViewedBody::Kind::bone;
    state_.bodies[0].world_from_body = identity_pose();
    state_.world_from_tool = identity_pose();
    if (const auto surface = source.surface()) {
        bone_ = sphere_around(*surface, state_).value_or(Sphere{});
        state_.world_from_tool.position = bone_.middle;
        renderer_.show(surface, state_);
    }
    see_from('0');
}

PictureArea LandmarkScreen::area() const {
    const auto wide = static_cast<float>(width_), tall = static_cast<float>(height_);
    return {std::min(panel_width, 0.5f * wide), top_height, wide, std::max(top_height + 1.0f, tall - bottom_height)};
}

// ---- the view -----------------------------------------------------------------------------------------------------

void LandmarkScreen::see_from(char side) {
    const Vec3 head{0, 0, 1}, front{0, -1, 0};
    const auto see = [&](Vec3 towards, Vec3 up) { camera_.see(bone_.middle, 0.85 * bone_.radius, towards, up); };
    switch (side) {
        case '1':
            see(front, head);
            break;
        case '2':
            see({0, 1, 0}, head);
            break;
        case '3':
            see({1, 0, 0}, head);
            break;
        case '4':
            see({-1, 0, 0}, head);
            break;
        case '5':
            see({0, 0, 1}, front);
            break;
        case '6':
            see({0, 0, -1}, front);
            break;
        default:
            see({-0.55, 0.75, 0.45}, head);
            break;
    }
    change_view();
}

void LandmarkScreen::change_view() {
    kept_.expire();
    is_overlay_old_ = true;
    move_cursor(cursor_x_, cursor_y_);
}

void LandmarkScreen::turn(double right, double up) {
    camera_.orbit(right, up);
    change_view();
}

void LandmarkScreen::zoom(double factor) {
    camera_.zoom(factor);
    change_view();
}

void LandmarkScreen::move_cursor(float x, float y) {
    cursor_x_ = x;
    cursor_y_ = y;
    under_cursor_.reset();
    const PictureArea area = this->area();
    if (area.contains(x, y)) under_cursor_ = source_->surface_point(camera_.eye(), area.direction_at(camera_, x, y));
}

// ---- input --------------------------------------------------------------------------------------------------------

void LandmarkScreen::take(const Input& input) {
    frames_due_ = 3;
    gui_.take(input);
    switch (input.kind) {
        case Input::Kind::key:
            take_key(input);
            break;
        case Input::Kind::button:
            take_button(input);
            break;
        case Input::Kind::move:
            take_motion(input);
            break;
        case Input::Kind::wheel:
            if (area().contains(cursor_x_, cursor_y_)) zoom(std::pow(0.9, static_cast<double>(input.wheel)));
            break;
        case Input::Kind::character:
            break;
    }
}

void LandmarkScreen::take_button(const Input& input) {
    if (input.code < 0 || input.code > 2) return;
    bool& is_held = is_held_[static_cast<std::size_t>(input.code)];
    const bool was_held = std::exchange(
        is_held, input.is_pressed && area().contains(cursor_x_, cursor_y_) && !(shows_keys_ && gui_.has_mouse()));
    if (input.code != 0) return;
    if (is_held) {
        pressed_x_ = cursor_x_;
        pressed_y_ = cursor_y_;
        has_moved_ = false;
        dragged_ = replaced_ ? std::nullopt : overlay_.end_at(cursor_x_, cursor_y_);
        if (dragged_) list_->select(dragged_->index);
    } else if (was_held) {
        if (!has_moved_ && !dragged_) pick();
        dragged_.reset();
        list_->end_move();
    }
}

void LandmarkScreen::take_motion(const Input& input) {
    const double right = static_cast<double>(input.x - cursor_x_) / std::max(height_, 1);
    const double down = static_cast<double>(input.y - cursor_y_) / std::max(height_, 1);
    has_moved_ = has_moved_ || std::hypot(input.x - pressed_x_, input.y - pressed_y_) > click_slack;
    const bool is_turning = is_held_[1] || (is_held_[0] && has_moved_ && !dragged_);
    move_cursor(input.x, input.y);
    if (is_turning) turn(5.0 * right, -5.0 * down);
    if (is_held_[2]) {
        camera_.pan(right, -down);
        change_view();
    }
    if (is_held_[0] && has_moved_ && dragged_ && under_cursor_) {
        list_->move(dragged_->index, dragged_->is_end, under_cursor_->position);
        change_list();
    }
}

void LandmarkScreen::take_key(const Input& input) {
    if (is_naming_ || gui_.has_keyboard()) {  // the name field takes it
        if (input.is_pressed && (input.code == Input::enter || input.code == Input::escape)) is_naming_ = false;
        return;
    }
    take_arrow(input);
    if (!input.is_pressed) return;
    if (input.has_control) return take_shortcut(input.code);
    if (input.code >= '0' && input.code <= '6') return see_from(static_cast<char>(input.code));
    switch (input.code) {
        case Input::f1:
            shows_keys_ = !shows_keys_;
            return;
        case Input::escape:
            shows_keys_ = false;
            replaced_.reset();
            return;
        case Input::space:
        case Input::enter:
            return pick();
        case 'G':
            if (under_cursor_) camera_.centre(under_cursor_->position);
            return change_view();
        case '=':
            return zoom(0.9);
        case '-':
            return zoom(1.0 / 0.9);
        default:
            return take_list_key(input);
    }
}

/// Takes a key that concerns the picked landmarks.
void LandmarkScreen::take_list_key(const Input& input) {
    const auto selected = list_->selected();
    switch (input.code) {
        case Input::tab:
            return list_->select_next(input.has_shift ? -1 : 1);
        case Input::f2:
            is_naming_ = focuses_name_ = selected.has_value();
            return;
        case 'A':
            return join();
        case 'X':
            if (selected) list_->reverse(*selected);
            return change_list();
        case 'R':
            if (!selected) return report("Select a landmark first, with Tab or a click.", true);
            replaced_ = LandmarkOverlay::End{*selected, input.has_shift && list_->all()[*selected].to.has_value()};
            return report("Pick the point again: it moves there. Esc: leave it.", false);
        case Input::erase:
        case Input::backspace:
            return remove();
        default:
            return;
    }
}

void LandmarkScreen::take_shortcut(int key) {
    if (key == 'Z') undo();
    if (key == 'C') copy_yaml();
    if (key == 'S') write();
}

/// The arrows move the cross-hair, or with Ctrl turn the bone, as long as they are held.
void LandmarkScreen::take_arrow(const Input& input) {
    constexpr std::array codes{Input::arrow_left, Input::arrow_right, Input::arrow_up, Input::arrow_down};
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (input.code != codes[i]) continue;
        arrows_[i] = input.is_pressed;
        if (!input.is_pressed) continue;
        turns_ = input.has_control;
        is_slow_ = input.has_shift;
        advance();
    }
}

void LandmarkScreen::advance() {
    const float right = static_cast<float>(arrows_[1]) - static_cast<float>(arrows_[0]);
    const float down = static_cast<float>(arrows_[3]) - static_cast<float>(arrows_[2]);
    if (right == 0.0f && down == 0.0f) return;
    if (turns_) return turn(static_cast<double>(0.03f * right), static_cast<double>(-0.03f * down));
    const float step = is_slow_ ? 0.25f : 2.0f;  // [pixel]
    move_cursor(cursor_x_ + step * right, cursor_y_ + step * down);
}

// ---- landmarks ----------------------------------------------------------------------------------------------------

void LandmarkScreen::report(const std::string& message, bool is_bad) {
    message_ = message;
    is_message_bad_ = is_bad;
}

void LandmarkScreen::change_list() { is_overlay_old_ = true; }

void LandmarkScreen::pick() {
    if (!under_cursor_) return report("There is no bone there: turn or move the picture.", true);
    put_point(under_cursor_->position);
}

void LandmarkScreen::put_point(Vec3 at) {
    report({}, false);
    if (replaced_) {
        list_->move(replaced_->index, replaced_->is_end, at);
        list_->end_move();
        replaced_.reset();
    } else {
        list_->add(free_name("point"), at);
    }
    change_list();
    state_.world_from_tool.position = at;  // bone is drawn finest there
    renderer_.show(source_->surface(), state_);
    kept_.expire();
}

void LandmarkScreen::join() {
    if (!list_->join(free_name("axis")))
        return report("An axis needs two points: pick them, first where it begins, then where it ends.", true);
    report({}, false);
    change_list();
}

void LandmarkScreen::remove() {
    if (const auto selected = list_->selected()) list_->remove(*selected);
    replaced_.reset();
    change_list();
}

void LandmarkScreen::undo() {
    if (!list_->undo()) return report("There is nothing to undo.", true);
    replaced_.reset();
    named_.reset();
    report({}, false);
    change_list();
}

std::string LandmarkScreen::free_name(const std::string& stem) const {
    for (int number = 1;; ++number) {
        std::string name = stem + "_" + std::to_string(number);
        if (!list_->has(name) && source_->problem_of_name(name).empty()) return name;
    }
}

std::string LandmarkScreen::problem_of(std::size_t index) const {
    const std::string& id = list_->all()[index].id;
    const auto& all = list_->all();
    const auto count = std::count_if(all.begin(), all.end(), [&](const PickedLandmark& one) { return one.id == id; });
    if (count > 1) return "Two picked landmarks have the name `" + id + "`. Rename one.";
    return source_->problem_of_name(id);
}

std::string LandmarkScreen::problem_of_any() const {
    if (list_->all().empty()) return "Nothing is picked yet. Click a point of the bone.";
    for (std::size_t i = 0; i < list_->all().size(); ++i)
        if (std::string problem = problem_of(i); !problem.empty()) return problem;
    return {};
}

void LandmarkScreen::copy_yaml() {
    if (const std::string problem = problem_of_any(); !problem.empty()) return report(problem, true);
    copied_ = source_->yaml(list_->all());
    report("Copied. Paste it below `landmarks:` of an anatomy.", false);
}

void LandmarkScreen::write() {
    if (const std::string problem = problem_of_any(); !problem.empty()) return report(problem, true);
    const std::size_t count = list_->all().size();
    if (const std::string error = source_->write(list_->all()); !error.empty()) return report(error, true);
    list_->clear();
    replaced_.reset();
    report(std::to_string(count) + (count == 1 ? " landmark" : " landmarks") + " written into " + source_->file_name() +
               ".",
           false);
    change_list();
}

// ---- drawing ------------------------------------------------------------------------------------------------------

bool LandmarkScreen::needs_frame() const noexcept {
    return gui_.has_waiting_input() || frames_due_ > 0 ||
           std::find(arrows_.begin(), arrows_.end(), true) != arrows_.end();
}

void LandmarkScreen::draw(int width, int height) {
    if (width < 1 || height < 1) return;
    if (width != width_ || height != height_) is_overlay_old_ = true;
    width_ = width;
    height_ = height;
    if (frames_due_ > 0) --frames_due_;
    advance();
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, width, height);
    glClearColor(0.114f, 0.129f, 0.149f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_bone();
    glViewport(0, 0, width, height);
    gui_.draw(width, height, [&](const Fonts& fonts) { paint(fonts); });
}

void LandmarkScreen::draw_bone() {
    const PictureArea area = this->area();
    const Rectangle where{static_cast<int>(area.left), height_ - static_cast<int>(area.bottom),
                          static_cast<int>(area.right) - static_cast<int>(area.left),
                          static_cast<int>(area.bottom) - static_cast<int>(area.top)};
    kept_.show(where, [&](const Rectangle& all) {
        renderer_.draw(state_, camera_, {.shows_zones = false, .shows_plan = false, .shows_force = false}, all);
    });
    if (std::exchange(is_overlay_old_, false)) overlay_.update(camera_, area, *source_, list_->all());
}

void LandmarkScreen::paint(const Fonts& fonts) {
    paint_top(fonts, static_cast<float>(width_), "Landmarks of " + source_->file_name());
    overlay_.paint(*ImGui::GetBackgroundDrawList(), fonts, area(), list_->selected());
    paint_cursor();
    paint_panel(fonts);
    paint_bottom(fonts);
    if (shows_keys_) paint_keys(fonts);
}

/// Paints a cross-hair where a pick would be.
void LandmarkScreen::paint_cursor() const {
    if (!under_cursor_ || dragged_) return;
    const auto at = area().pixel_of(camera_, under_cursor_->position);
    if (!at) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    constexpr float inner = 4.0f, outer = 12.0f;
    for (const ImVec2 out : {ImVec2{1, 0}, ImVec2{-1, 0}, ImVec2{0, 1}, ImVec2{0, -1}})
        for (const auto& [colour, wide] : {std::pair(IM_COL32(0, 0, 0, 160), 3.0f), std::pair(theme::text, 1.4f)})
            list.AddLine({at->x + inner * out.x, at->y + inner * out.y}, {at->x + outer * out.x, at->y + outer * out.y},
                         colour, wide);
}

void LandmarkScreen::paint_panel(const Fonts& fonts) {
    const PictureArea area = this->area();
    begin_panel("landmarks", {0, area.top}, {area.left, static_cast<float>(height_)});
    paint_picked(fonts);
    paint_selected(fonts);
    paint_actions(fonts);
    paint_written(fonts);
    end_panel();
}

void LandmarkScreen::paint_picked(const Fonts& fonts) {
    heading(fonts, "PICKED, not yet in the file");
    if (list_->all().empty()) wrapped(theme::soft, "Click a point of the bone. Two points are an axis.");
    constexpr std::size_t shown_rows = 7;
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const auto rows = static_cast<float>(std::min(shown_rows, list_->all().size()));
    if (rows > 0.0f) {
        ImGui::BeginChild("picked", {0.0f, rows * row + 4.0f});
        for (std::size_t i = 0; i < list_->all().size(); ++i) {
            const PickedLandmark& one = list_->all()[i];
            const bool is_selected = list_->selected() == i, is_wrong = !problem_of(i).empty();
            ImGui::PushID(static_cast<int>(i));
            ImGui::PushStyleColor(ImGuiCol_Text, rgba(is_wrong      ? theme::bad
                                                      : is_selected ? theme::limit
                                                                    : theme::text));
            if (ImGui::Selectable(((one.to ? "→ " : "● ") + one.id).c_str(), is_selected)) list_->select(i);
            if (is_selected) ImGui::SetScrollHereY();
            ImGui::PopStyleColor();
            ImGui::PopID();
        }
        ImGui::EndChild();
    }
}

/// Paints the name field and the position of the selected landmark.
void LandmarkScreen::paint_selected(const Fonts& fonts) {
    const auto selected = list_->selected();
    if (!selected) {
        named_.reset();
        is_naming_ = false;
        return;
    }
    const PickedLandmark& one = list_->all()[*selected];
    if (named_ != selected || (!is_naming_ && one.id != name_.data())) copy(one.id, name_);
    named_ = selected;
    ImGui::SetNextItemWidth(-1.0f);
    const bool focuses = std::exchange(focuses_name_, false);
    if (focuses) ImGui::SetKeyboardFocusHere();
    if (ImGui::InputTextWithHint("##name", "name", name_.data(), name_.size(), ImGuiInputTextFlags_AutoSelectAll)) {
        list_->rename(*selected, name_.data());
        change_list();
    }
    if (ImGui::IsItemActive()) is_naming_ = true;
    if (ImGui::IsItemDeactivated()) is_naming_ = false;
    ImGui::PushFont(fonts.small);
    const std::string problem = problem_of(*selected);
    if (!problem.empty()) wrapped(theme::bad, problem);
    wrapped(theme::soft, source_->description(list_->all()[*selected]));
    ImGui::PopFont();
}

void LandmarkScreen::paint_actions(const Fonts& fonts) {
    ImGui::Dummy({0.0f, 2.0f});
    const bool is_empty = list_->all().empty();
    const float wide = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    const auto button = [](const char* words, bool can, ImVec2 size) {
        ImGui::BeginDisabled(!can);
        const bool is_pressed = ImGui::Button(words, size);
        ImGui::EndDisabled();
        return is_pressed;
    };
    if (button("Axis of two  (A)", list_->joinable().has_value(), {wide, 0})) join();
    ImGui::SameLine();
    if (button("Undo  (Ctrl+Z)", true, {wide, 0})) undo();
    if (button("Copy as YAML  (Ctrl+C)", !is_empty, {-1, 0})) copy_yaml();
    const std::string write_words = "Write into the file  (Ctrl+S)";
    ImGui::PushStyleColor(ImGuiCol_Button, rgba(theme::lit));
    if (button(write_words.c_str(), !is_empty, {-1, 34})) write();
    ImGui::PopStyleColor();
    ImGui::PushFont(fonts.small);
    if (!message_.empty()) wrapped(is_message_bad_ ? theme::bad : theme::good, message_);
    ImGui::PopFont();
    ImGui::Dummy({0.0f, 4.0f});
}

void LandmarkScreen::paint_written(const Fonts& fonts) const {
    heading(fonts, "IN THE FILE");
    ImGui::BeginChild("written");
    ImGui::PushFont(fonts.small);
    for (const PickedLandmark& one : source_->written()) {
        wrapped(theme::text, (one.to ? "→ " : "● ") + one.id);
        ImGui::Indent(14.0f);
        wrapped(theme::soft, source_->description(one));
        ImGui::Unindent(14.0f);
    }
    if (source_->written().empty()) wrapped(theme::soft, "It has no points and no axes.");
    ImGui::PopFont();
    ImGui::EndChild();
}

void LandmarkScreen::paint_bottom(const Fonts& fonts) const {
    const PictureArea area = this->area();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({area.left, area.bottom}, {area.right, static_cast<float>(height_)}, theme::bar);
    const std::string left =
        under_cursor_ ? millimetres(under_cursor_->position) + "   " + under_cursor_->tissue : "no bone here";
    const std::string hint = "click: point   drag: turn   wheel: zoom   F1: all keys";
    const float y = area.bottom + 9.0f,
                hint_wide = fonts.small->CalcTextSizeA(fonts.small->FontSize, 1e9f, 0.0f, hint.c_str()).x;
    list.AddText(fonts.text, fonts.text->FontSize, {area.left + 14.0f, y - 1.0f},
                 under_cursor_ ? theme::text : theme::soft, left.c_str());
    if (area.right - area.left > hint_wide + 330.0f)
        list.AddText(fonts.small, fonts.small->FontSize, {area.right - hint_wide - 14.0f, y}, theme::soft,
                     hint.c_str());
}

void LandmarkScreen::paint_keys(const Fonts& fonts) const {
    constexpr std::pair<const char*, const char*> keys[] = {
        {"click, Space, Enter", "pick the point at the cross-hair"},
        {"arrows, with Shift", "move the cross-hair, slowly"},
        {"drag, Ctrl + arrows", "turn the bone"},
        {"middle drag; wheel, + −", "move; zoom"},
        {"G", "put the point at the cross-hair into the middle"},
        {"1 2 3 4 5 6", "from the front, back, left, right, head, foot"},
        {"0", "from behind, the right and above"},
        {"drag a picked point", "move it along the surface"},
        {"R, Shift + R", "pick the selected point, or the end of an axis, again"},
        {"Tab, Shift + Tab", "select the next or the previous landmark"},
        {"F2", "rename the selected landmark"},
        {"A", "axis of the selected point and the point before it"},
        {"X", "reverse an axis"},
        {"Delete", "remove the selected landmark"},
        {"Ctrl + Z", "undo the last change"},
        {"Ctrl + C", "copy as YAML"},
        {"Ctrl + S", "write into the file"},
        {"F12", "save a picture"},
        {"Ctrl + Q", "close"}};
    const PictureArea area = this->area();
    const float wide = std::min(560.0f, area.right - area.left),
                tall = 26.0f * static_cast<float>(std::size(keys)) + 56.0f;
    const ImVec2 low{0.5f * (area.left + area.right - wide),
                     std::max(area.top, 0.5f * (area.top + area.bottom - tall))};
    begin_panel("keys", low, {low.x + wide, std::min(low.y + tall, area.bottom)});
    heading(fonts, "KEYS     F1 or Esc closes this page");
    if (ImGui::BeginTable("keys", 2)) {
        ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 190.0f);
        for (const auto& [key, what] : keys) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextColored(rgba(theme::limit), "%s", key);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(what);
        }
        ImGui::EndTable();
    }
    end_panel();
}

}  // namespace kerf::window
