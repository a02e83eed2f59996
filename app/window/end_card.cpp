// SPDX-License-Identifier: Apache-2.0
#include "app/window/end_card.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "app/window/panel_painter.h"
#include "app/window/window_text.h"

namespace kerf::window {

namespace {

constexpr ImU32 background = IM_COL32(0x1a, 0x21, 0x29, 255);
constexpr std::size_t max_reasons = 2, max_deductions = 4;
constexpr int reason_lines = 3, deduction_lines = 3, folder_lines = 2, notice_lines = 2;
constexpr float line_height = 21.0f, button_height = 26.0f, button_gap = 6.0f, margins = 24.0f;
constexpr const char* notice = "For training and research; not for diagnosis, planning or deciding treatment.";

std::string verdict_text(const run::ViewedResult& result) {
    return (result.verdict == "pass" ? "✓ " : "✗ ") + result.verdict +
           (std::isfinite(result.score) ? formatted("   %.0f of 100", result.score) : "");
}

ImU32 verdict_colour(const run::ViewedResult& result) { return result.verdict == "pass" ? theme::good : theme::bad; }

/// Paints the parts of a card from top to bottom.
class Card {
public:
    Card(const CardModel& model, const run::ViewedResult& result, ImVec2 corner, float width, float space,
         const Fonts& fonts, ImDrawList& list)
        : model_(&model),
          result_(&result),
          fonts_(&fonts),
          width_(width),
          deductions_(fitting_deductions(space)),
          painter_(list, fonts, {corner.x - width, corner.y - height(deductions_)}, corner, background) {}

    std::vector<CardLink> paint() {
        paint_verdict();
        for (std::size_t i = 0; i < std::min(max_reasons, result_->reasons.size()); ++i)
            painter_.paragraph(result_->reasons[i], theme::text, reason_lines);
        if (deductions_ > 0) {
            painter_.skip(4.0f);
            const auto has_time = [](const run::ViewedResult::Deduction& one) { return one.time >= 0.0; };
            const auto first = result_->deductions.begin();
            const bool has_moments = std::any_of(first, first + static_cast<std::ptrdiff_t>(deductions_), has_time);
            painter_.heading(has_moments ? "DEDUCTIONS   ↑ ↓ show the moment" : "DEDUCTIONS");
            for (std::size_t i = 0; i < deductions_; ++i) paint_deduction(i);
        }
        for (const Button& button : buttons()) paint_button(button);
        if (!result_->folder.empty())
            painter_.paragraph("Report: " + result_->folder + "/report.html", theme::soft, folder_lines);
        painter_.paragraph(notice, theme::soft, notice_lines);
        return links_;
    }

private:
    struct Button {
        std::string words, key;
        CardAction action;
    };

    [[nodiscard]] std::vector<Button> buttons() const {
        using Kind = CardAction::Kind;
        std::vector<Button> all;
        if (model_->buttons.has_again) all.push_back({"Again, as a new attempt", "N", {Kind::again}});
        if (model_->buttons.has_debrief)
            all.push_back(
                {"Replay from " + clock_text(model_->debrief_from), "D", {Kind::debrief, model_->debrief_from}});
        if (model_->buttons.has_resume && model_->debrief_from > 0.0)
            all.push_back(
                {"Operate from " + clock_text(model_->debrief_from), "K", {Kind::resume, model_->debrief_from}});
        if (model_->buttons.has_start_page) all.push_back({"Start page", "Enter", {Kind::leave}});
        return all;
    }

    [[nodiscard]] float height_of(const std::string& text, int max_lines) const {
        return height_of_paragraph(fonts_->small, text, width_, max_lines);
    }
    [[nodiscard]] float height(std::size_t deductions) const {
        float tall = margins + fonts_->large->FontSize + 6.0f + height_of(notice, notice_lines);
        for (std::size_t i = 0; i < std::min(max_reasons, result_->reasons.size()); ++i)
            tall += height_of(result_->reasons[i], reason_lines);
        if (deductions > 0) tall += 26.0f;
        for (std::size_t i = 0; i < deductions; ++i)
            tall += line_height + height_of(result_->deductions[i].words, deduction_lines) + 3.0f;
        tall += static_cast<float>(buttons().size()) * (button_height + button_gap);
        if (!result_->folder.empty()) tall += height_of("Report: " + result_->folder + "/report.html", folder_lines);
        return tall;
    }
    [[nodiscard]] std::size_t fitting_deductions(float space) const {
        std::size_t count = listed_deductions(*result_);
        while (count > 0 && height(count) > space) --count;
        return count;
    }

    void paint_verdict() {
        const float top = painter_.top();
        painter_.line_in(fonts_->large, verdict_text(*result_), verdict_colour(*result_));
        const ImVec2 low{painter_.right() - 14.0f, top};
        painter_.list().AddText(fonts_->small, fonts_->small->FontSize, low, theme::soft, "E");
        links_.push_back({{painter_.left(), top}, {painter_.right(), painter_.top()}, {CardAction::Kind::toggle}});
    }

    void paint_deduction(std::size_t number) {
        const run::ViewedResult::Deduction& one = result_->deductions[number];
        const bool has_time = one.time >= 0.0;
        const float top = painter_.top();
        const float bottom = top + line_height + height_of(one.words, deduction_lines);
        if (model_->chosen == number)
            painter_.list().AddRectFilled({painter_.left() - 6, top - 2}, {painter_.right() + 6, bottom}, theme::lit,
                                          3.0f);
        painter_.line(has_time ? "▸ " + clock_text(one.time) : "whole run", theme::modelled,
                      formatted("−%.1f", one.points), theme::limit);
        painter_.paragraph(one.words, theme::text, deduction_lines);
        painter_.skip(3.0f);
        if (has_time)
            links_.push_back(
                {{painter_.left(), top}, {painter_.right(), bottom}, {CardAction::Kind::show_moment, one.time}});
    }

    void paint_button(const Button& button) {
        const ImVec2 low{painter_.left(), painter_.top()}, high{painter_.right(), low.y + button_height};
        painter_.list().AddRectFilled(low, high, theme::lit, 4.0f);
        const float wide = fonts_->text->CalcTextSizeA(fonts_->text->FontSize, 1e9f, 0.0f, button.key.c_str()).x;
        painter_.list().AddText(fonts_->text, fonts_->text->FontSize, {low.x + 10, low.y + 4}, theme::text,
                                button.words.c_str());
        painter_.list().AddText(fonts_->text, fonts_->text->FontSize, {high.x - wide - 10, low.y + 4}, theme::soft,
                                button.key.c_str());
        links_.push_back({low, high, button.action});
        painter_.skip(button_height + button_gap);
    }

    const CardModel* model_;
    const run::ViewedResult* result_;
    const Fonts* fonts_;
    float width_;
    std::size_t deductions_;
    PanelPainter painter_;
    std::vector<CardLink> links_;
};

/// Paints the line of a closed card.
std::vector<CardLink> paint_closed(const run::ViewedResult& result, ImVec2 corner, float width, const Fonts& fonts,
                                   ImDrawList& list) {
    const ImVec2 low{corner.x - width, corner.y - closed_card_height};
    PanelPainter painter(list, fonts, low, corner, background);
    painter.skip(-4.0f);
    painter.line(verdict_text(result), verdict_colour(result), "E: result", theme::soft);
    return {{low, corner, {CardAction::Kind::toggle}}};
}

}  // namespace

std::size_t listed_deductions(const run::ViewedResult& result) noexcept {
    return std::min(max_deductions, result.deductions.size());
}

std::vector<CardLink> paint_card(const CardModel& model, ImVec2 corner, float width, float space, const Fonts& fonts,
                                 ImDrawList& list) {
    if (!model.result->has_value()) {
        PanelPainter painter(list, fonts, {corner.x - width, corner.y - 50.0f}, corner, background);
        painter.line("Writing the results …", theme::soft);
        return {};
    }
    const run::ViewedResult& result = **model.result;
    if (!model.is_open) return paint_closed(result, corner, width, fonts, list);
    return Card(model, result, corner, width, space, fonts, list).paint();
}

}  // namespace kerf::window
