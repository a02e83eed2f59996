// SPDX-License-Identifier: Apache-2.0
#include "app/window/panel_painter.h"

#include <algorithm>
#include <cmath>

#include "app/window/window_text.h"

namespace kerf::window {

namespace {

ImVec2 size_of(ImFont* font, const std::string& text, float wrap = 0.0f) {
    return font->CalcTextSizeA(font->FontSize, 1e9f, wrap, text.c_str());
}

constexpr float line_gap = 3.0f;  // [pixels] between lines of a paragraph

/// Returns where the next line of a text begins that is wrapped at words. Pre: from < end
const char* end_of_line(ImFont* font, const char* from, const char* end, float width) {
    const char* to = font->CalcWordWrapPositionA(1.0f, from, end, width);
    if (to == from) ++to;
    while (to < end && *to == ' ') ++to;
    return to;
}

/// Returns a round step for about three lines over a range.
float grid_step(float range) {
    const float raw = std::max(range, 1e-6f) / 3.0f, power = std::pow(10.0f, std::floor(std::log10(raw)));
    for (const float factor : {1.0f, 2.0f, 5.0f})
        if (raw <= factor * power) return factor * power;
    return 10.0f * power;
}

}  // namespace

std::string shortened(ImFont* font, const std::string& text, float width) {
    if (size_of(font, text).x <= width) return text;
    std::string kept = text;
    while (!kept.empty() && size_of(font, kept + "…").x > width) {
        kept.pop_back();
        while (!kept.empty() && (static_cast<unsigned char>(kept.back()) & 0xc0) == 0x80) kept.pop_back();
        if (!kept.empty() && (static_cast<unsigned char>(kept.back()) & 0xc0) == 0xc0) kept.pop_back();
    }
    return kept + "…";
}

PanelPainter::PanelPainter(ImDrawList& list, const Fonts& fonts, ImVec2 low, ImVec2 high, ImU32 background)
    : list_(&list), fonts_(&fonts), low_(low), high_(high), y_(low.y + 12.0f) {
    list.AddRectFilled(low, high, background);
}

void PanelPainter::heading(const std::string& text, const std::string& value) {
    list_->AddText(fonts_->small, fonts_->small->FontSize, {left(), y_ + 2}, theme::soft, text.c_str());
    if (!value.empty()) {
        const float wide = size_of(fonts_->bold, value).x;
        list_->AddText(fonts_->bold, fonts_->bold->FontSize, {right() - wide, y_}, theme::text, value.c_str());
    }
    y_ += 22.0f;
}

void PanelPainter::line(const std::string& text, ImU32 colour, const std::string& value, ImU32 value_colour) {
    const float wide = value.empty() ? 0.0f : size_of(fonts_->text, value).x + 8.0f;
    list_->AddText(fonts_->text, fonts_->text->FontSize, {left(), y_}, colour,
                   shortened(fonts_->text, text, width() - wide).c_str());
    if (!value.empty())
        list_->AddText(fonts_->text, fonts_->text->FontSize, {right() - wide + 8.0f, y_}, value_colour, value.c_str());
    y_ += 21.0f;
}

void PanelPainter::line_in(ImFont* font, const std::string& text, ImU32 colour) {
    list_->AddText(font, font->FontSize, {left(), y_}, colour, shortened(font, text, width()).c_str());
    y_ += font->FontSize + 6.0f;
}

void PanelPainter::paragraph(const std::string& text, ImU32 colour, int max_lines, ImFont* font, float spare) {
    ImFont* used = font != nullptr ? font : fonts_->small;
    const float wide = width() - spare;
    const char *from = text.c_str(), *end = from + text.size();
    for (int i = 0; i < max_lines && from < end; ++i) {
        const char* to = i + 1 == max_lines ? end : end_of_line(used, from, end, wide);
        std::string line(from, to);
        while (!line.empty() && line.back() == ' ') line.pop_back();
        list_->AddText(used, used->FontSize, {left(), y_}, colour, shortened(used, line, wide).c_str());
        y_ += used->FontSize + line_gap;
        from = to;
    }
}

float height_of_paragraph(ImFont* font, const std::string& text, float width, int max_lines) {
    const char *from = text.c_str(), *end = from + text.size();
    int lines = 0;
    for (; lines < max_lines && from < end; ++lines)
        from = end_of_line(font, from, end, width - 2.0f * PanelPainter::margin);
    return static_cast<float>(lines) * (font->FontSize + line_gap);
}

void PanelPainter::bar(double fraction, ImU32 colour, float height) {
    const float end = left() + width() * static_cast<float>(std::clamp(fraction, 0.0, 1.0));
    list_->AddRectFilled({left(), y_}, {right(), y_ + height}, theme::bar, 2.0f);
    if (end > left() + 1.0f) list_->AddRectFilled({left(), y_}, {end, y_ + height}, colour, 2.0f);
    y_ += height + 8.0f;
}

void paint_plot(ImDrawList& list, const Fonts& fonts, ImVec2 low, ImVec2 high, const PlotAxes& axes,
                const std::vector<PlotLine>& lines) {
    list.AddRectFilled(low, high, theme::bar, 3.0f);
    list.PushClipRect(low, high, true);
    const float x_range = std::max(axes.x_high - axes.x_low, 1e-6f),
                y_range = std::max(axes.y_high - axes.y_low, 1e-6f);
    const auto at = [&](ImVec2 p) {
        return ImVec2{low.x + (p.x - axes.x_low) / x_range * (high.x - low.x),
                      high.y - (p.y - axes.y_low) / y_range * (high.y - low.y)};
    };
    const float step = grid_step(y_range);
    for (float value = std::ceil(axes.y_low / step) * step; value < axes.y_high; value += step) {
        const float y = at({0, value}).y;
        list.AddLine({low.x, y}, {high.x, y}, theme::line);
        const std::string text = formatted("%g", std::abs(value) < 1e-6f ? 0.0 : static_cast<double>(value));
        list.AddText(fonts.small, fonts.small->FontSize, {low.x + 4, y - fonts.small->FontSize - 1}, theme::soft,
                     text.c_str());
    }
    for (const float limit : axes.limits) {
        const float y = at({0, limit}).y;
        for (float x = low.x; x < high.x; x += 9.0f) list.AddLine({x, y}, {x + 5.0f, y}, theme::limit, 1.5f);
    }
    for (const PlotLine& line : lines) {
        std::vector<ImVec2> points;
        points.reserve(line.points.size());
        for (const ImVec2& p : line.points) points.push_back(at(p));
        list.AddPolyline(points.data(), static_cast<int>(points.size()), line.colour, 0, 1.6f);
    }
    list.PopClipRect();
}

}  // namespace kerf::window
