// SPDX-License-Identifier: Apache-2.0
#include "app/window/start_screen.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/window/panel_painter.h"
#include "app/window/step_view.h"
#include "app/window/widgets.h"

namespace kerf::window {

namespace {

std::string minutes(double seconds) {
    char text[32];
    const long whole = std::lround(std::clamp(seconds, 0.0, 1e6));
    std::snprintf(text, sizeof text, "%ld:%02ld min", whole / 60, whole % 60);
    return text;
}

/// A list with one entry chosen. Returns whether the user chose `words`.
bool entry(const std::string& words, bool is_chosen) {
    return ImGui::Selectable((words + "##" + words).c_str(), is_chosen) && !is_chosen;
}

/// A list without a choice.
void paint_fixed(const char* id, const char* shown) {
    ImGui::BeginDisabled();
    if (ImGui::BeginCombo(id, shown)) ImGui::EndCombo();
    ImGui::EndDisabled();
}

}  // namespace

StartScreen::StartScreen(StartSource& source, StartSelection& selection) : source_(&source), selection_(&selection) {
    set_style();
    copy(selection.learner, learner_);
}

const StartProcedure* StartScreen::procedure() const {
    return selection_->procedure < page_->procedures.size() ? &page_->procedures[selection_->procedure] : nullptr;
}

// ---- input --------------------------------------------------------------------------------------------------------

void StartScreen::take(const Input& input) {
    frames_due_ = 3;
    gui_.take(input);
    const StartLayout layout{static_cast<float>(width_), static_cast<float>(height_)};
    const bool is_in_picture = !gui_.has_mouse() && mouse_x_ > layout.left() && mouse_x_ < layout.right() &&
                               mouse_y_ > layout.picture_low() && mouse_y_ < layout.picture_high();
    if (input.kind == Input::Kind::button) is_turning_ = input.is_pressed && is_in_picture;
    if (input.kind == Input::Kind::wheel && is_in_picture) {
        camera_.zoom(std::pow(0.9, static_cast<double>(input.wheel)));
        kept_.expire();
    }
    if (input.kind != Input::Kind::move) return;
    const double right = static_cast<double>(input.x - mouse_x_) / std::max(height_, 1);
    const double down = static_cast<double>(input.y - mouse_y_) / std::max(height_, 1);
    if (is_turning_) {
        camera_.orbit(5.0 * right, -5.0 * down);
        kept_.expire();
    }
    mouse_x_ = input.x;
    mouse_y_ = input.y;
}

// ---- drawing ------------------------------------------------------------------------------------------------------

StartAction StartScreen::draw(int width, int height) {
    action_ = {};
    if (width < 1 || height < 1) return action_;
    width_ = width;
    height_ = height;
    if (frames_due_ > 0) --frames_due_;
    page_ = &source_->page(*selection_);
    const StartLayout layout{static_cast<float>(width), static_cast<float>(height)};
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, width, height);
    glClearColor(0.114f, 0.129f, 0.149f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_picture(layout);
    glViewport(0, 0, width, height);
    gui_.draw(width, height, [&](const Fonts& fonts) { paint(layout, fonts); });
    return action_;
}

/// Takes over a new picture from the source.
void StartScreen::take_picture() {
    const auto newest = source_->picture(*selection_);
    if (newest == picture_) return;
    renderer_.reset();
    picture_ = newest;
    if (picture_ == nullptr) return;
    kept_.expire();
    renderer_ = std::make_unique<SceneRenderer>(picture_->scene);
    renderer_->show(picture_->surface, picture_->state);
    const auto bone = sphere_around(*picture_->surface, picture_->state);
    if (bone && !picture_->scene.steps.empty()) see_step(camera_, '3', picture_->scene.steps.front(), *bone);
}

/// Returns whether the chosen operation is an examination: its help is hidden here, too.
bool StartScreen::is_examination() const { return !selection_->device.empty() && selection_->mode == "exam"; }

void StartScreen::draw_picture(const StartLayout& layout) {
    take_picture();
    if (std::exchange(was_examination_, is_examination()) != is_examination()) kept_.expire();
    const Rectangle where{static_cast<int>(layout.left()), height_ - static_cast<int>(layout.picture_high()),
                          static_cast<int>(layout.right()) - static_cast<int>(layout.left()),
                          static_cast<int>(layout.picture_high()) - static_cast<int>(layout.picture_low())};
    if (renderer_ == nullptr || where.width < 1 || where.height < 1) return;
    kept_.show(where, [&](const Rectangle& all) {
        ViewSettings settings;
        settings.shows_force = false;
        settings.shows_zones = settings.shows_plan = !is_examination();
        renderer_->draw(picture_->state, camera_, settings, all);
    });
}

void StartScreen::paint(const StartLayout& layout, const Fonts& fonts) {
    paint_top(fonts, layout.width);
    paint_procedures(layout, fonts);
    paint_title(layout, fonts);
    paint_steps(layout, fonts);
    paint_choices(layout, fonts);
    paint_attempts(layout, fonts);
}

// ---- left: procedures ---------------------------------------------------------------------------------------------

void StartScreen::paint_procedures(const StartLayout& layout, const Fonts& fonts) {
    begin_panel("procedures", {0, StartLayout::top}, {layout.left(), layout.height});
    heading(fonts, "OPERATIONS");
    ImGui::BeginChild("list", {0.0f, -92.0f});
    for (std::size_t i = 0; i < page_->procedures.size(); ++i) paint_procedure(i, fonts);
    if (page_->procedures.empty()) wrapped(theme::soft, "This folder has no procedure that can be used.");
    ImGui::PushFont(fonts.small);
    for (const std::string& refused : page_->refused) wrapped(theme::bad, refused);
    ImGui::PopFont();
    ImGui::EndChild();
    paint_folder(fonts);
    end_panel();
}

void StartScreen::paint_procedure(std::size_t index, const Fonts& fonts) {
    const StartProcedure& one = page_->procedures[index];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float wide = ImGui::GetContentRegionAvail().x, text_wide = wide - 12.0f;
    const float title = fonts.bold->CalcTextSizeA(fonts.bold->FontSize, 1e9f, text_wide, one.title.c_str()).y;
    ImGui::PushID(static_cast<int>(index));
    const bool is_chosen = ImGui::Selectable("##procedure", index == selection_->procedure, 0, {wide, title + 26.0f});
    ImGui::PopID();
    if (is_chosen && index != selection_->procedure) {
        selection_->procedure = index;
        selection_->variant.clear();
        selection_->rehearsal.clear();
        source_->forget_message();
        frames_due_ = 3;
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(fonts.bold, fonts.bold->FontSize, {at.x + 6, at.y + 3}, theme::text, one.title.c_str(), nullptr,
                 text_wide);
    list.AddText(fonts.small, fonts.small->FontSize, {at.x + 6, at.y + title + 7}, theme::soft,
                 shortened(fonts.small, one.summary, text_wide).c_str());
}

void StartScreen::paint_folder(const Fonts& fonts) {
    ImGui::Separator();
    heading(fonts, "A FOLDER OF YOUR OWN");
    ImGui::SetNextItemWidth(-1.0f);
    const bool is_entered = ImGui::InputTextWithHint("##folder", page_->folder.c_str(), folder_.data(), folder_.size(),
                                                     ImGuiInputTextFlags_EnterReturnsTrue);
    const bool is_opened = ImGui::Button("Open");
    ImGui::SameLine();
    const bool is_reset = ImGui::Button("Shipped ones");
    if ((is_entered || is_opened) && folder_[0] != '\0')
        source_->open_folder(folder_.data());
    else if (is_reset)
        source_->open_folder("");
    if (is_entered || is_opened || is_reset) frames_due_ = 3;
}

// ---- centre: the chosen procedure ---------------------------------------------------------------------------------

void StartScreen::paint_title(const StartLayout& layout, const Fonts& fonts) const {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float x = layout.left() + 14.0f, wide = layout.right() - layout.left() - 28.0f;
    list.AddRectFilled({layout.left(), StartLayout::top}, {layout.right(), layout.picture_low()}, theme::bar);
    if (const StartProcedure* one = procedure(); one != nullptr) {
        list.AddText(fonts.large, fonts.large->FontSize, {x, StartLayout::top + 4}, theme::text,
                     shortened(fonts.large, one->title, wide).c_str());
        const std::string line =
            one->summary +
            (page_->details.time_limit > 0.0 ? ", time limit " + minutes(page_->details.time_limit) : "");
        list.AddText(fonts.small, fonts.small->FontSize, {x, StartLayout::top + 27}, theme::soft,
                     shortened(fonts.small, line, wide).c_str());
    }
    if (renderer_ == nullptr)
        list.AddText(fonts.text, fonts.text->FontSize, {x, layout.picture_low() + 12}, theme::soft,
                     shortened(fonts.text, source_->picture_state(), wide).c_str());
    else
        list.AddText(fonts.small, fonts.small->FontSize, {x, layout.picture_high() - 20}, theme::soft,
                     "drag to turn, wheel to zoom");
}

void StartScreen::paint_steps(const StartLayout& layout, const Fonts& fonts) const {
    begin_panel("steps", {layout.left(), layout.picture_high()}, {layout.right(), layout.bottom()});
    if (is_examination()) wrapped(theme::limit, "An examination shows no zones, no limits and no plan.");
    if (!page_->details.error.empty()) wrapped(theme::bad, page_->details.error);
    for (std::size_t i = 0; i < page_->details.steps.size(); ++i) {
        const StartDetails::Step& step = page_->details.steps[i];
        ImGui::PushFont(fonts.bold);
        wrapped(theme::text, std::to_string(i + 1) + "  " + step.title);
        ImGui::PopFont();
        ImGui::Indent(20.0f);
        std::string goals, limits;
        for (const std::string& goal : step.goals) goals += (goals.empty() ? "" : ", ") + goal;
        for (const std::string& limit : step.limits) limits += (limits.empty() ? "" : ", ") + limit;
        wrapped(theme::modelled, "with the " + step.tool + ": " + goals);
        ImGui::PushFont(fonts.small);
        if (!limits.empty() && !is_examination()) wrapped(theme::soft, "Limits: " + limits);
        ImGui::PopFont();
        ImGui::Unindent(20.0f);
    }
    end_panel();
}

// ---- right: choices -----------------------------------------------------------------------------------------------

std::string StartScreen::why_not_start() const {
    if (procedure() == nullptr) return "Choose an operation.";
    if (!page_->details.error.empty()) return "This variant cannot be used.";
    if (!page_->learner_refusal.empty()) return page_->learner_refusal;
    if (selection_->device.empty() && page_->details.rehearsals.empty())
        return "The operation has no rehearsal, and no device is chosen.";
    return {};
}

void StartScreen::paint_choices(const StartLayout& layout, const Fonts& fonts) {
    begin_panel("choices", {layout.right(), StartLayout::top}, {layout.width, layout.bottom()});
    ImGui::PushItemWidth(-1.0f);
    heading(fonts, "LEARNER'S CODE, never a name");
    if (ImGui::InputTextWithHint("##learner", "none", learner_.data(), learner_.size()))
        selection_->learner = learner_.data();
    paint_operator(fonts);
    paint_variant(fonts);
    heading(fonts, "MODE");
    if (selection_->device.empty()) {
        paint_fixed("##mode", "demo");
    } else if (ImGui::BeginCombo("##mode", selection_->mode.c_str())) {
        for (const char* mode : {"practice", "exam", "demo"})
            if (entry(mode, selection_->mode == mode)) selection_->mode = mode;
        ImGui::EndCombo();
    }
    paint_assist(fonts);
    ImGui::PopItemWidth();
    ImGui::Dummy({0.0f, 2.0f});
    const std::string why_not = why_not_start();
    ImGui::BeginDisabled(!why_not.empty());
    ImGui::PushStyleColor(ImGuiCol_Button, rgba(theme::lit));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, rgba(IM_COL32(0x3a, 0x68, 0x8a, 255)));
    ImGui::PushFont(fonts.large);
    if (ImGui::Button(selection_->device.empty() ? "Watch" : "Start", {-1.0f, 44.0f}))
        action_ = {.kind = StartAction::Kind::start};
    ImGui::PopFont();
    ImGui::PopStyleColor(2);
    ImGui::EndDisabled();
    ImGui::PushFont(fonts.small);
    if (!why_not.empty()) wrapped(theme::limit, why_not);
    if (!page_->message.empty()) wrapped(page_->is_message_bad ? theme::bad : theme::good, page_->message);
    ImGui::PopFont();
    paint_devices(fonts);
    end_panel();
}

/// Lists the devices with a lamp each: green if it can be used.
void StartScreen::paint_devices(const Fonts& fonts) const {
    ImGui::Dummy({0.0f, 4.0f});
    heading(fonts, "DEVICES");
    const auto line = [&](bool is_ready, const std::string& words) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 6.0f, at.y + 7.0f}, 5.0f,
                                                    is_ready ? theme::good : theme::line, 20);
        ImGui::Indent(20.0f);
        ImGui::PushFont(fonts.small);
        wrapped(is_ready ? theme::text : theme::soft, words);
        ImGui::PopFont();
        ImGui::Unindent(20.0f);
    };
    for (const StartDevice& device : page_->devices)
        line(device.is_ready(), device.name + (device.problem.empty() ? "" : ": " + device.problem));
    if (page_->devices.empty()) line(false, "None is connected. To watch an operation, none is needed.");
}

void StartScreen::paint_operator(const Fonts& fonts) {
    heading(fonts, "WHO OPERATES");
    const auto& rehearsals = page_->details.rehearsals;
    std::string shown = "nobody";
    if (!rehearsals.empty()) shown = "Watch: " + rehearsals.front().title;
    for (const StartEntry& rehearsal : rehearsals)
        if (rehearsal.id == selection_->rehearsal) shown = "Watch: " + rehearsal.title;
    for (const StartDevice& device : page_->devices)
        if (!device.id.empty() && device.id == selection_->device) shown = "You, with " + device.name;
    if (!ImGui::BeginCombo("##operator", shown.c_str())) return;
    for (const StartDevice& device : page_->devices) {
        if (!device.is_ready()) continue;
        if (entry("You, with " + device.name, device.id == selection_->device)) selection_->device = device.id;
    }
    for (const StartEntry& rehearsal : rehearsals) {
        const std::string words = "Watch: " + rehearsal.title;
        if (!entry(words, selection_->device.empty() && shown == words)) continue;
        selection_->rehearsal = rehearsal.id;
        selection_->device.clear();
    }
    ImGui::EndCombo();
}

void StartScreen::paint_assist(const Fonts& fonts) {
    heading(fonts, "HELP with plan, zones, limits and hints");
    if (is_examination()) return paint_fixed("##assist", "off");
    const std::string own = "as written: " + page_->details.assist;
    if (!ImGui::BeginCombo("##assist", selection_->assist.empty() ? own.c_str() : selection_->assist.c_str())) return;
    if (entry(own, selection_->assist.empty())) selection_->assist.clear();
    for (const std::string& level : page_->assist_levels)
        if (entry(level, selection_->assist == level)) selection_->assist = level;
    ImGui::EndCombo();
}

void StartScreen::paint_variant(const Fonts& fonts) {
    const StartProcedure* one = procedure();
    heading(fonts, "VARIANT");  // always there, so that the button below stays where it is
    if (one == nullptr || one->variants.empty()) {
        paint_fixed("##variant", "none");
        return;
    }
    constexpr const char* none = "as written";
    std::string shown = none;
    for (const StartEntry& variant : one->variants)
        if (variant.id == selection_->variant) shown = variant.title;
    if (!ImGui::BeginCombo("##variant", shown.c_str())) return;
    if (entry(none, selection_->variant.empty())) selection_->variant.clear();
    for (const StartEntry& variant : one->variants)
        if (entry(variant.title, variant.id == selection_->variant)) selection_->variant = variant.id;
    ImGui::EndCombo();
}

// ---- bottom: attempts ---------------------------------------------------------------------------------------------

void StartScreen::paint_attempts(const StartLayout& layout, const Fonts& fonts) {
    begin_panel("attempts", {layout.left(), layout.bottom()}, {layout.width, layout.height}, theme::bar);
    const std::string whose =
        selection_->learner.empty() ? "ATTEMPTS without a code" : "ATTEMPTS of " + selection_->learner;
    heading(fonts, whose.c_str());
    ImGui::SameLine(ImGui::GetWindowWidth() - 150.0f);
    ImGui::Checkbox("all operations", &selection_->shows_all_attempts);
    const StartProcedure* one = procedure();
    bool has_any = false;
    if (ImGui::BeginTable("table", 6, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY)) {
        const std::pair<const char*, float> columns[] = {{"Operation", 0.0f}, {"Attempt", 58.0f}, {"Result", 100.0f},
                                                         {"Score", 48.0f},    {"Time", 78.0f},    {"", 172.0f}};
        ImGui::TableSetupScrollFreeze(0, 1);
        for (const auto& [name, wide] : columns)
            ImGui::TableSetupColumn(
                name, wide > 0.0f ? ImGuiTableColumnFlags_WidthFixed : ImGuiTableColumnFlags_WidthStretch, wide);
        ImGui::TableHeadersRow();
        for (std::size_t i = 0; i < page_->attempts.size(); ++i) {
            const StartAttempt& attempt = page_->attempts[i];
            const bool is_of_chosen = one != nullptr && attempt.procedure == one->id;
            if (!is_of_chosen && !selection_->shows_all_attempts) continue;
            has_any = true;
            paint_attempt(i, attempt);
        }
        ImGui::EndTable();
    }
    if (!has_any) {
        ImGui::SetCursorPosY(64.0f);
        wrapped(theme::soft, "None yet. Each attempt gets a folder of its own in " + page_->attempts_folder + ".");
    }
    end_panel();
}

void StartScreen::paint_attempt(std::size_t index, const StartAttempt& attempt) {
    const auto of_it = std::find_if(page_->procedures.begin(), page_->procedures.end(),
                                    [&](const StartProcedure& one) { return one.id == attempt.procedure; });
    const std::string title = of_it != page_->procedures.end() ? of_it->title : attempt.procedure;
    const bool is_pass = attempt.verdict == "pass";
    const bool is_judged = is_pass || attempt.verdict == "fail";
    ImGui::PushID(static_cast<int>(index));
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted((title + (attempt.is_demonstration ? ", watched" : "")).c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%d", attempt.number);
    ImGui::TableNextColumn();
    ImGui::TextColored(rgba(is_pass     ? theme::good
                            : is_judged ? theme::bad
                                        : theme::limit),
                       "%s",
                       ((is_pass     ? "✓ "
                         : is_judged ? "✗ "
                                     : "") +
                        attempt.verdict)
                           .c_str());
    ImGui::TableNextColumn();
    if (attempt.score) ImGui::Text("%.0f", *attempt.score);
    ImGui::TableNextColumn();
    if (attempt.duration) ImGui::TextUnformatted(minutes(*attempt.duration).c_str());
    ImGui::TableNextColumn();
    ImGui::BeginDisabled(!attempt.has_session);
    if (ImGui::SmallButton("Watch again")) action_ = {StartAction::Kind::watch, index};
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!attempt.has_report);
    if (ImGui::SmallButton("Report")) action_ = {StartAction::Kind::report, index};
    ImGui::EndDisabled();
    ImGui::PopID();
}

}  // namespace kerf::window
