// SPDX-License-Identifier: Apache-2.0
#include "app/window/panels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/window/inspection_panel.h"
#include "app/window/panel_painter.h"
#include "app/window/window_text.h"

namespace kerf::window {

namespace {

/// Returns the running step; null after the last one.
const run::ViewedStep* step_of(const PanelModel& model) {
    const auto number = static_cast<std::size_t>(std::max(0, model.state->step));
    return number < model.scene->steps.size() ? &model.scene->steps[number] : nullptr;
}

/// Returns the running step if the trainee may see its limits, plan and hint; else null.
const run::ViewedStep* helped_step(const PanelModel& model) { return model.state->has_help ? step_of(model) : nullptr; }

/// Returns the first goal of the step that is not reached, in words.
std::string next_goal(const PanelModel& model, const run::ViewedStep& step) {
    for (std::size_t g = 0; g < step.goals.size() && g < 32; ++g)
        if ((model.state->goals_done >> g & 1u) == 0) return step.goals[g].words;
    return "withdraw the tool";
}

/// Returns ", help on request"; empty if the steps have all help, or it is an examination.
std::string assist_in_words(const PanelModel& model) {
    using Assist = run::ViewedScene::Assist;
    if (model.scene->is_examination) return {};
    return model.scene->assist == Assist::off          ? ", no help"
           : model.scene->assist == Assist::on_request ? ", help on request"
           : model.scene->assist == Assist::stepwise   ? ", help by steps"
                                                       : "";
}

// ---- top and bottom -----------------------------------------------------------------------------------------------

void paint_top(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    list.AddRectFilled({0, 0}, {layout.width, Layout::top}, theme::header);
    const float text_y = 11.0f;
    list.AddText(fonts.bold, fonts.bold->FontSize, {14, text_y}, theme::text,
                 shortened(fonts.bold, model.scene->title, 0.36f * layout.width).c_str());
    const std::string mode = model.scene->mode + assist_in_words(model) + " · " + model.scene->hand;
    list.AddText(fonts.text, fonts.text->FontSize, {0.40f * layout.width, text_y}, theme::soft,
                 shortened(fonts.text, mode, 0.2f * layout.width).c_str());
    const bool is_late = model.real_time_factor < 0.97 && !model.state->is_over;
    const ImU32 lamp = model.state->is_faulty                   ? theme::bad
                       : is_late || model.state->is_gate_closed ? theme::limit
                                                                : theme::good;
    const float x = layout.width - 486.0f;
    if (!model.duration) {  // a recorded run has no pace
        list.AddCircleFilled({x, 19}, 6.0f, lamp);
        const std::string pace = formatted("%.2f×   late %u", model.real_time_factor, model.state->late_ticks);
        list.AddText(fonts.text, fonts.text->FontSize, {x + 14, text_y}, theme::text, pace.c_str());
    }
    list.AddText(fonts.text, fonts.text->FontSize, {x + 150, text_y}, theme::soft, model.renderer.c_str());
    list.AddText(fonts.text, fonts.text->FontSize, {layout.width - 192, text_y}, theme::text,
                 (clock_text(model.state->time) + " of " + clock_text(model.scene->time_limit)).c_str());
    list.AddText(fonts.text, fonts.text->FontSize, {layout.width - 70, text_y}, theme::soft, "F1 keys");
}

ImU32 colour_of(run::ViewedEvent::Kind kind) {
    using Kind = run::ViewedEvent::Kind;
    switch (kind) {
        case Kind::goal:
        case Kind::step:
            return theme::good;
        case Kind::limit:
            return theme::limit;
        case Kind::fault:
            return theme::bad;
        case Kind::image:
        case Kind::note:
            break;
    }
    return theme::modelled;
}

/// Returns "live", "▶ 1×" or "paused".
std::string pace_text(const Timeline& timeline, bool is_over) {
    if (timeline.is_following()) return is_over ? "end" : "live";
    if (!timeline.is_playing()) return "paused";
    return timeline.speed() < 1.0 ? formatted("play 1/%.0f", 1.0 / timeline.speed())
                                  : formatted("play %.0f×", timeline.speed());
}

/// Paints the time line with a mark for each event. Goals, limits and radiographs have marks of their own shape.
void paint_bottom(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    const float top = layout.height - Layout::bottom, y = top + 17.0f, from = layout.line_from(), to = layout.line_to();
    list.AddRectFilled({0, top}, {layout.width, layout.height}, theme::header);
    if (model.scene->is_examination && !model.state->is_over) {
        list.AddText(fonts.text, fonts.text->FontSize, {14, top + 10}, theme::soft, "Examination: no help, no undo");
        return;
    }
    const double span = line_span(*model.timeline, model.duration);
    const auto at = [&](double time) {
        return from + (to - from) * static_cast<float>(std::clamp(time / span, 0.0, 1.0));
    };
    list.AddText(fonts.text, fonts.text->FontSize, {14, top + 10}, theme::soft,
                 pace_text(*model.timeline, model.state->is_over).c_str());
    list.AddRectFilled({from, y - 2}, {to, y + 2}, theme::line, 2.0f);
    list.AddRectFilled({from, y - 2}, {at(model.timeline->newest()), y + 2}, theme::modelled, 2.0f);
    for (const run::ViewedEvent& event : model.timeline->events()) {
        const float x = at(event.time);
        if (event.kind == run::ViewedEvent::Kind::limit || event.kind == run::ViewedEvent::Kind::fault) {
            list.AddTriangleFilled({x - 6, y - 12}, {x + 6, y - 12}, {x, y - 2}, colour_of(event.kind));
        } else if (event.kind == run::ViewedEvent::Kind::image) {
            list.AddRectFilled({x - 4.5f, y + 5}, {x + 4.5f, y + 14}, theme::text, 1.0f);
            list.AddCircleFilled({x, y + 9.5f}, 2.5f, theme::header);
        } else if (event.kind != run::ViewedEvent::Kind::note) {
            list.AddCircleFilled({x, y}, 4.5f, colour_of(event.kind));
        }
    }
    const float x = at(model.state->time);
    list.AddRectFilled({x - 2, y - 10}, {x + 2, y + 10}, theme::text, 1.5f);
    list.AddText(fonts.text, fonts.text->FontSize, {to + 14, top + 10}, theme::text,
                 model.duration ? clock_text(span).c_str() : "");
}

// ---- left: steps, depth, zones, tool ------------------------------------------------------------------------------

void paint_steps(const PanelModel& model, PanelPainter& painter) {
    painter.heading("STEPS");
    const auto current = static_cast<std::size_t>(std::max(0, model.state->step));
    for (std::size_t s = 0; s < model.scene->steps.size(); ++s) {
        const bool is_done = s < current, is_now = s == current;
        const std::string title = formatted("%zu  ", s + 1) + model.scene->steps[s].title;
        constexpr int max_lines = 3;
        constexpr float mark = 18.0f;
        ImFont* font = painter.fonts().text;
        const float tall = height_of_paragraph(font, title, Layout::left - mark, max_lines);
        if (is_now)
            painter.list().AddRectFilled({painter.left() - 6, painter.top() - 3},
                                         {painter.right() + 6, painter.top() + tall}, theme::lit, 3.0f);
        if (is_done)
            painter.list().AddText(font, font->FontSize, {painter.right() - 12, painter.top()}, theme::good, "✓");
        painter.paragraph(title, is_done ? theme::soft : theme::text, max_lines, font, mark);
        painter.skip(4.0f);
        // For the panels that follow, and the titles of the steps that do.
        const float below = 330.0f + 40.0f * static_cast<float>(model.scene->steps.size() - s - 1);
        const bool has_details = model.scene->assist == run::ViewedScene::Assist::full && s > current;
        for (const run::ViewedLimit& goal : model.scene->steps[s].goals)
            if (has_details && painter.space() > below) painter.line("     " + goal.words, theme::soft);
    }
}

void paint_depth(const PanelModel& model, const run::ViewedStep& step, PanelPainter& painter) {
    painter.skip(8.0f);
    painter.heading("DEPTH", formatted("%.1f mm", 1e3 * std::max(0.0, model.state->depth)));
    const double goal = step.depth_goal.value_or(step.length), deep = std::max(0.0, model.state->depth);
    const std::optional<double> limit = model.state->has_help ? step.depth_limit : std::nullopt;
    const double full = 1.08 * std::max({1.3 * goal, limit.value_or(0.0), deep, 1e-3});
    const bool is_too_deep = limit && deep > *limit;
    const float y = painter.top();
    painter.bar(deep / full, is_too_deep ? theme::bad : theme::modelled, 14.0f);
    const auto mark = [&](double depth, ImU32 colour) {
        const float x = painter.left() + painter.width() * static_cast<float>(depth / full);
        painter.list().AddLine({x, y - 3}, {x, y + 17}, colour, 2.0f);
    };
    if (step.depth_goal) mark(goal, theme::text);
    if (limit) mark(*limit, theme::limit);
    if (step.depth_goal) painter.line("goal", theme::soft, formatted("%.1f mm", 1e3 * goal));
    if (limit) painter.line("limit", theme::limit, formatted("%.1f mm", 1e3 * *limit), theme::limit);
    painter.line("cortices passed", theme::soft, formatted("%u", model.state->cortices));
}

void paint_zone(const PanelModel& model, PanelPainter& painter) {
    if (model.state->zone < 0) return;
    constexpr double warn = 2e-3, shown = 10e-3;
    const double distance = model.state->zone_distance;
    const auto zone = static_cast<std::size_t>(model.state->zone);
    painter.skip(8.0f);
    painter.heading("NEAREST ZONE");
    painter.line(model.scene->zones[zone].name);
    const bool is_in = distance <= 0.0, is_near = distance < warn;
    const ImU32 colour = is_in ? theme::forbidden : is_near ? theme::limit : theme::good;
    painter.bar(std::clamp(distance, 0.0, shown) / shown, colour, 10.0f);
    painter.line(is_in     ? "inside!"
                 : is_near ? "close"
                           : "well clear",
                 colour, formatted("%.1f mm", 1e3 * distance), colour);
}

/// Paints the hint of the step, or how to get its help.
void paint_hint(const PanelModel& model, PanelPainter& painter) {
    using Assist = run::ViewedScene::Assist;
    const run::ViewedStep* step = helped_step(model);
    const bool is_on_request = model.scene->assist == Assist::on_request && !model.state->has_help &&
                               step_of(model) != nullptr && !model.duration;
    if (painter.space() < 60.0f || !(is_on_request || (step != nullptr && !step->hint.empty()))) return;
    painter.skip(8.0f);
    painter.heading("HINT");
    painter.paragraph(
        is_on_request ? "H shows plan, zones, limits and hint of this step. The record counts it." : step->hint,
        is_on_request ? theme::soft : theme::text, 6);
}

void paint_left(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    PanelPainter painter(list, fonts, {0, Layout::top}, {Layout::left, layout.height - Layout::bottom}, theme::panel);
    paint_steps(model, painter);
    const run::ViewedStep* step = step_of(model);
    if (step != nullptr) paint_depth(model, *step, painter);
    paint_zone(model, painter);
    paint_hint(model, painter);
    painter.skip(8.0f);
    painter.heading("TOOL");
    if (model.state->tool < model.scene->tools.size()) painter.line(model.scene->tools[model.state->tool].name);
    const double tenths = std::round(1e4 * model.state->feed), feed = tenths == 0.0 ? 0.0 : 0.1 * tenths;  // no "-0.0"
    painter.line("feed", model.state->is_running ? theme::text : theme::soft, formatted("%.1f mm/s", feed));
    painter.line(model.state->tissue >= 0
                     ? "in " + model.scene->tissues[static_cast<std::size_t>(model.state->tissue)].name
                     : "in air",
                 theme::soft);
    if (model.lead != nullptr)
        painter.line(model.lead->totals().is_driving ? "drive on" : "drive off",
                     model.lead->totals().is_driving ? theme::good : theme::soft);
    else if (model.state->is_running)
        painter.line("running", theme::good);
    if (!model.next_action.empty() && painter.space() > 60.0f) {
        painter.skip(8.0f);
        painter.heading("NEXT ACTION");
        painter.paragraph(model.next_action + (model.lead != nullptr ? "  (Enter)" : ""), theme::text, 3);
    }
    if (model.lead == nullptr || painter.space() < 100.0f) return;
    painter.skip(8.0f);
    const LeadKeys& keys = model.lead->keys();
    const auto letter = [](int code) { return std::string(1, static_cast<char>(code)); };
    const bool wheel_feeds = lead_of(*model.scene, *model.state) == run::ViewedTool::Lead::across;
    for (const std::string& words :
         {wheel_feeds ? std::string("drag moves, wheel feeds")
                      : "drag and wheel move, " + letter(keys.feed) + " " + letter(keys.withdraw) + " feed",
          std::string("Space drives, T latches it"),
          letter(keys.tilt) + " + drag tilts, " + letter(keys.turn_left) + " " + letter(keys.turn_right) + " turn",
          std::string(model.scene->is_examination ? "" : "Backspace undoes, Esc pauses")})
        painter.paragraph(words, theme::soft, 1);
}

// ---- centre -------------------------------------------------------------------------------------------------------

/// Returns whether a mouse presses the tool against bone while its drive is off; not in an examination.
bool is_pressed_without_drive(const PanelModel& model) {
    constexpr double touch = 2.0;  // [N]
    return model.lead != nullptr && !model.scene->is_examination && !model.lead->totals().is_driving &&
           model.state->force > touch;
}

void paint_header(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    const ImVec2 low{Layout::left, Layout::top}, high{layout.width - Layout::right, Layout::top + Layout::header};
    list.AddRectFilled(low, high, theme::bar);
    const run::ViewedStep* step = step_of(model);
    const float wide = high.x - low.x - 28.0f;
    const std::string title =
        step == nullptr ? "All steps are done"
                        : formatted("%d  ", model.state->step + 1) + step->title + ": " + next_goal(model, *step);
    list.AddText(fonts.bold, fonts.bold->FontSize, {low.x + 14, low.y + 5}, theme::text,
                 shortened(fonts.bold, title, wide).c_str());
    std::string hint;
    const bool is_live = model.timeline->is_following() && !model.state->is_over;
    ImU32 colour = theme::limit;
    if (step != nullptr && model.state->broken != 0) {
        for (std::size_t i = 0; i < step->limits.size() && i < run::max_viewed_limits; ++i)
            if ((model.state->broken >> i & 1u) != 0) hint = "Limit broken: " + step->limits[i].words;
        colour = theme::bad;
    } else if (is_live && model.lead != nullptr && model.lead->is_paused()) {
        hint = "Paused. Esc continues.";
    } else if (is_live && model.state->time < model.scene->repeated) {
        hint = formatted("Repeating the first %.1f s of the earlier operation. Then the mouse leads.",
                         model.scene->repeated);
        colour = theme::soft;
    } else if (is_live && is_pressed_without_drive(model)) {
        hint = "The drive is off. Hold Space, or latch it by T.";
    } else if (model.state->is_gate_closed) {
        hint = "The force has faded; it returns when hand and tool are together again.";
    } else if (!model.next_action.empty()) {
        hint = "Next action: " + model.next_action;
    }
    list.AddText(fonts.text, fonts.text->FontSize, {low.x + 14, low.y + 25}, colour,
                 shortened(fonts.text, hint, wide).c_str());
}

/// Paints the sentence about what the view lacks, at the lower edge of the picture.
void paint_note(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    if (model.scene->note.empty()) return;
    constexpr int max_lines = 4;
    constexpr float margin = 8.0f;
    const ImVec2 low = layout.picture_low();
    ImVec2 high = layout.picture_high();
    if (!layout.has_panels && model.card.result->has_value()) high.x -= Layout::right + 12.0f;  // the card
    const float wide = high.x - low.x, tall = height_of_paragraph(fonts.small, model.scene->note, wide, max_lines);
    PanelPainter painter(list, fonts, {low.x, high.y - tall - 2.0f * margin}, high, theme::bar);
    painter.skip(margin - 12.0f);
    painter.paragraph(model.scene->note, theme::limit, max_lines);
}

/// Paints one line without panels: how they come back, and the values that matter most.
void paint_hint_about_panels(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    constexpr float tall = 20.0f;
    const std::string how = Layout::fits(layout.width, layout.height)
                                ? "Tab: panels"
                                : formatted("Panels need %.0f × %.0f pixels", Layout::min_width, Layout::min_height);
    const std::string values = model.scene->is_examination ? ""
                                                           : formatted("   %s   depth %.1f mm   force %.0f N",
                                                                       clock_text(model.state->time).c_str(),
                                                                       1e3 * model.state->depth, model.state->force);
    list.AddRectFilled({0, 0}, {layout.width, tall}, theme::header);
    list.AddText(fonts.small, fonts.small->FontSize, {8, 3}, theme::soft,
                 shortened(fonts.small, how + values, layout.width - 16.0f).c_str());
}

/// Paints the card with the result; after the end, and in one line at an earlier moment.
std::vector<CardLink> paint_result(const PanelModel& model, const Layout& layout, const Fonts& fonts,
                                   ImDrawList& list) {
    if (!model.state->is_over && !model.card.result->has_value()) return {};
    constexpr float force_plot = 190.0f, margin = 12.0f;
    const ImVec2 corner = layout.has_panels ? ImVec2{layout.width, layout.height - Layout::bottom}
                                            : ImVec2{layout.width - margin, layout.height - margin};
    const float above = layout.has_panels ? Layout::top + force_plot : margin;
    return paint_card(model.card, corner, Layout::right, corner.y - above, fonts, list);
}

// ---- right: plots and limits --------------------------------------------------------------------------------------

std::optional<double> bound_of(const run::ViewedStep* step, const std::string& quantity) {
    if (step != nullptr)
        for (const run::ViewedLimit& limit : step->limits)
            if (limit.quantity == quantity && limit.at_most) return limit.at_most;
    return std::nullopt;
}

void paint_force(const PanelModel& model, const run::ViewedStep* step, PanelPainter& painter) {
    painter.heading("FORCE, last 5 s", formatted("%.1f N", model.state->force));
    PlotLine modelled{{}, theme::modelled}, on_hand{{}, theme::on_hand};
    const std::span<const run::ViewedRow> rows = model.timeline->recent();
    const float now = static_cast<float>(model.state->time);
    PlotAxes axes{.x_low = -static_cast<float>(Timeline::plot_span), .x_high = 0.0f, .y_low = 0.0f, .y_high = 10.0f};
    const std::size_t stride = std::max<std::size_t>(1, rows.size() / 400);
    for (std::size_t i = 0; i < rows.size(); i += stride) {
        run::ViewedRow row = rows[i];
        for (std::size_t k = i; k < std::min(i + stride, rows.size()); ++k) {
            row.force = std::max(row.force, rows[k].force);
            row.hand_force = std::max(row.hand_force, rows[k].hand_force);
        }
        const float time = static_cast<float>(row.time) - now;
        modelled.points.push_back({time, row.force});
        on_hand.points.push_back({time, row.hand_force});
        axes.y_high = std::max({axes.y_high, 1.1f * row.force, 1.1f * row.hand_force});
    }
    if (const auto limit = bound_of(step, "thrust")) {
        axes.limits.push_back(static_cast<float>(*limit));
        axes.y_high = std::max(axes.y_high, 1.1f * axes.limits.back());
    }
    const float height = 110.0f;
    paint_plot(painter.list(), painter.fonts(), {painter.left(), painter.top()},
               {painter.right(), painter.top() + height}, axes, {modelled, on_hand});
    painter.skip(height + 4.0f);
    ImDrawList& list = painter.list();
    const Fonts& fonts = painter.fonts();
    const auto legend = [&](float x, const char* text, ImU32 colour) {
        list.AddText(fonts.small, fonts.small->FontSize, {painter.left() + x, painter.top()}, colour, text);
    };
    legend(0, "— modelled", theme::modelled);
    legend(92, "— on the hand", theme::on_hand);
    if (!axes.limits.empty()) legend(200, "- - limit", theme::limit);
    painter.skip(24.0f);
}

void paint_torque(const PanelModel& model, const run::ViewedStep* step, PanelPainter& painter) {
    const bool has_thread =
        model.state->tool < model.scene->tools.size() && model.scene->tools[model.state->tool].lead > 0.0;
    if (!has_thread) return;
    painter.heading("TORQUE over turns", formatted("%.2f N·m", model.state->torque));
    PlotLine torque{{}, theme::modelled};
    PlotAxes axes{.x_low = 0.0f, .x_high = 5.0f, .y_low = 0.0f, .y_high = 0.5f};
    constexpr float turn = 6.2831853f;
    const std::span<const Timeline::Turn> turns = model.timeline->turns();
    const float sign = !turns.empty() && turns.back().turned < 0.0f ? -1.0f : 1.0f;
    for (const Timeline::Turn& one : turns) {
        torque.points.push_back({sign * one.turned / turn, one.torque});
        axes.x_high = std::max(axes.x_high, sign * one.turned / turn);
        axes.y_high = std::max(axes.y_high, 1.1f * one.torque);
        axes.y_low = std::min(axes.y_low, 1.1f * one.torque);
    }
    if (const auto limit = bound_of(step, "torque")) {
        axes.limits.push_back(static_cast<float>(*limit));
        axes.y_high = std::max(axes.y_high, 1.1f * axes.limits.back());
    }
    const float height = 90.0f;
    paint_plot(painter.list(), painter.fonts(), {painter.left(), painter.top()},
               {painter.right(), painter.top() + height}, axes, {torque});
    painter.skip(height + 10.0f);
}

void paint_limits(const PanelModel& model, const run::ViewedStep& step, PanelPainter& painter) {
    if (step.limits.empty()) return;
    painter.skip(4.0f);
    painter.heading("LIMITS OF THE STEP");
    for (std::size_t i = 0; i < step.limits.size() && i < run::max_viewed_limits; ++i) {
        if (painter.space() < 36.0f) {
            painter.line("…", theme::soft);
            return;
        }
        const run::ViewedLimit& limit = step.limits[i];
        const bool is_broken = (model.state->broken >> i & 1u) != 0;
        const double value = static_cast<double>(model.state->limit_values[i]);
        const std::string now = std::isnan(value) ? "" : formatted("%.3g", value / limit.per_unit);
        painter.line(limit.words, is_broken ? theme::bad : theme::text, now, is_broken ? theme::bad : theme::soft);
        if (limit.at_most && *limit.at_most > 0.0 && !limit.at_least) {
            painter.skip(-2.0f);
            const double fraction = std::isnan(value) ? 0.0 : value / *limit.at_most;
            painter.bar(fraction, is_broken ? theme::bad : fraction > 0.8 ? theme::limit : theme::good, 5.0f);
        }
    }
}

/// Returns the height of the limits of a step [pixels].
float height_of_limits(const run::ViewedStep* step) {
    if (step == nullptr || step->limits.empty()) return 0.0f;
    float height = 26.0f;
    for (const run::ViewedLimit& limit : step->limits)
        height += limit.at_most && *limit.at_most > 0.0 && !limit.at_least ? 32.0f : 21.0f;
    return height;
}

/// Paints the last radiograph as large as the limits below it allow, but not smaller than they could be read with.
void paint_radiograph(const PanelModel& model, const run::ViewedStep* step, PanelPainter& painter) {
    constexpr float texts = 22.0f + 21.0f + 8.0f, smallest = 200.0f;
    const RadiographModel& one = model.radiograph;
    const bool has_picture = one.texture != 0;
    if ((one.radiograph == nullptr && one.arm.empty()) || painter.space() < texts) return;
    painter.heading("FLUOROSCOPY", formatted("shots %u", model.state->shots));
    if (has_picture && painter.space() >= smallest + 21.0f) {
        const float space = painter.space() - 29.0f - height_of_limits(step);
        const float edge = std::clamp(space, smallest, painter.width());
        const float left = painter.left() + 0.5f * (painter.width() - edge), top = painter.top();
        painter.list().AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(one.texture)), {left, top},
                                {left + edge, top + edge});
        painter.list().AddText(painter.fonts().small, painter.fonts().small->FontSize, {painter.left(), top},
                               theme::soft, one.radiograph->words.c_str());
        painter.skip(edge + 4.0f);
    } else if (one.radiograph != nullptr && !one.radiograph->error.empty()) {
        painter.paragraph("No picture: " + one.radiograph->error, theme::limit, 3);
    }
    if (!one.arm.empty()) painter.paragraph(one.arm + " · F takes an image · A turns the arm", theme::soft, 1);
    painter.skip(4.0f);
}

void paint_right(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    const float card = model.card.result->has_value() ? closed_card_height : 0.0f;
    const ImVec2 low{layout.width - Layout::right, Layout::top}, high{layout.width, layout.height - Layout::bottom};
    list.AddRectFilled(low, high, theme::panel);
    PanelPainter painter(list, fonts, low, {high.x, high.y - card}, theme::panel);
    const run::ViewedStep* step = helped_step(model);
    paint_force(model, step, painter);
    if (model.layers.is_any() && model.inspection != nullptr) {
        paint_inspection_values(*model.inspection, *model.scene, model.layers, painter);
        return;
    }
    paint_torque(model, step, painter);
    paint_radiograph(model, step, painter);
    if (step != nullptr) paint_limits(model, *step, painter);
}

// ---- over the picture ---------------------------------------------------------------------------------------------

void paint_keys(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    const float wide = 460.0f, tall = 44.0f + 21.0f * static_cast<float>(key_help(model).size());
    const ImVec2 low{0.5f * (layout.width - wide), std::max(10.0f, 0.5f * (layout.height - tall))};
    PanelPainter painter(list, fonts, low, {low.x + wide, low.y + tall}, IM_COL32(0x12, 0x16, 0x1b, 245));
    painter.line_in(fonts.bold, "Keys", theme::text);
    for (const KeyHelp& help : key_help(model)) painter.line(help.words, theme::text, help.key, theme::modelled);
}

void paint_values(const PanelModel& model, const Layout& layout, const Fonts& fonts, ImDrawList& list) {
    const ImVec2 low = layout.picture_low();
    PanelPainter painter(list, fonts, {low.x + 12, low.y + 12}, {low.x + 322, low.y + 222},
                         IM_COL32(0x12, 0x16, 0x1b, 220));
    const run::ViewedState& s = *model.state;
    painter.line("thrust", theme::soft, formatted("%.1f N", s.thrust));
    painter.line("torque", theme::soft, formatted("%.3f N·m", s.torque));
    painter.line("feed", theme::soft, formatted("%.2f mm/s", 1e3 * s.feed));
    painter.line("bone removed", theme::soft, formatted("%.1f mm³", 1e9 * s.removed));
    const Vec3 tip = s.world_from_tool.position;
    painter.line("tip", theme::soft, formatted("%.1f  %.1f  %.1f mm", 1e3 * tip.x, 1e3 * tip.y, 1e3 * tip.z));
    painter.line("device force scale", theme::soft, formatted("1/%.1f", 1.0 / s.device_scale));
    painter.line("triangles", theme::soft, formatted("%zu", model.triangles));
    painter.line("frame", theme::soft, formatted("%.1f ms", 1e3 * model.frame_time));
    painter.line("tick", theme::soft, formatted("%llu", static_cast<unsigned long long>(s.tick)));
}

/// What mouse and wheel do to a tool, for people.
struct LeadWords {
    const char *drag, *wheel;
};

LeadWords words_of(run::ViewedTool::Lead lead) {
    using Lead = run::ViewedTool::Lead;
    switch (lead) {
        case Lead::across:
            return {"move the tool across its axis", "feed, or withdraw"};
        case Lead::in_blade:
            return {"move the saw in the plane of its blade", "move the saw across its blade"};
        case Lead::facing:
            break;
    }
    return {"move the tool in the plane of the picture", "move the tool away, or nearer"};
}

}  // namespace

double line_span(const Timeline& timeline, const std::optional<double>& duration) {
    if (duration) return std::max(*duration, 1e-3);
    return std::max(30.0, 1.25 * timeline.newest());
}

std::vector<KeyHelp> key_help(const PanelModel& model) {
    std::vector<KeyHelp> keys{{"F1", "this page"}, {"F2", "values"}};
    if (model.lead != nullptr) {
        const bool is_left = model.lead->is_left_handed();
        const LeadWords words = words_of(lead_of(*model.scene, *model.state));
        const std::vector<KeyHelp> of_lead{{is_left ? "right drag" : "left drag", words.drag},
                                           {"wheel", words.wheel},
                                           {is_left ? "I, K" : "W, S", "feed, withdraw: along the axis"},
                                           {"arrows", "move the tool"},
                                           {is_left ? "Y + drag" : "R + drag", "tilt the tool about its tip, in air"},
                                           {is_left ? "U, O" : "Q, E", "turn a screw or tap; in air, any tool"},
                                           {"Space", "drive while held"},
                                           {"T", "drive until T again"},
                                           {"Enter", "the next action of the step"},
                                           {"Backspace", "undo the last cut or action"},
                                           {"Shift", "a fifth of the speed"},
                                           {"Esc", "pause"},
                                           {"F3", "other hand"}};
        keys.insert(keys.end(), of_lead.begin(), of_lead.end());
    } else {
        keys.push_back({"Space", "play or pause"});
    }
    const bool is_left = model.lead != nullptr && model.lead->is_left_handed();
    if (!model.scene->is_examination) keys.push_back({"F4", "inspect the law: all, contacts, field, coupling"});
    const std::vector<KeyHelp> of_view{{"1, 2, 3", "see the whole bone, along the tool, from the side"},
                                       {"4", "follow the tip, near"},
                                       {"X", "see through bone"},
                                       {"C", "cut bone away at the tool"},
                                       {"Z, P, V", "zones, plan, arrow of force"},
                                       {"F, A", "take a radiograph, turn the C-arm"},
                                       {is_left ? "left drag" : "right drag", "turn the view"},
                                       {"middle drag", "move the view"},
                                       {"Ctrl + wheel", "zoom"},
                                       {", and .", "one moment back or on"},
                                       {"[ and ]", "play slower or faster"},
                                       {"L", "back to the live end"},
                                       {"Tab", "hide the panels"},
                                       {"F12", "save a picture"},
                                       {"E, ↑ ↓", "after the end: result, deductions"},
                                       {"N, D, K", "after the end: again, replay, operate from here"},
                                       {"Ctrl + Q", "end the operation; then close the window"}};
    if (model.scene->assist == run::ViewedScene::Assist::on_request)
        keys.push_back({"H", "show the help of this step"});
    keys.insert(keys.end(), of_view.begin(), of_view.end());
    return keys;
}

std::vector<CardLink> paint_panels(const PanelModel& model, const Layout& layout, const Fonts& fonts) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    if (layout.has_panels) {
        paint_left(model, layout, fonts, list);
        paint_right(model, layout, fonts, list);
        paint_header(model, layout, fonts, list);
        paint_bottom(model, layout, fonts, list);
        paint_top(model, layout, fonts, list);
    } else {
        paint_hint_about_panels(model, layout, fonts, list);
    }
    paint_note(model, layout, fonts, list);
    std::vector<CardLink> links = paint_result(model, layout, fonts, list);
    if (model.shows_values) paint_values(model, layout, fonts, list);
    if (model.shows_keys) paint_keys(model, layout, fonts, list);
    return links;
}

}  // namespace kerf::window
