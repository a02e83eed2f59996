// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/window/theme.h"

namespace kerf::window {

/// Paints texts, bars and plots line by line from the top of a panel. Lengths in pixels.
class PanelPainter {
public:
    static constexpr float margin = 14.0f;

    PanelPainter(ImDrawList& list, const Fonts& fonts, ImVec2 low, ImVec2 high, ImU32 background);

    /// Moves down.
    void skip(float height) { y_ += height; }
    [[nodiscard]] float left() const noexcept { return low_.x + margin; }
    [[nodiscard]] float right() const noexcept { return high_.x - margin; }
    [[nodiscard]] float width() const noexcept { return right() - left(); }
    [[nodiscard]] float top() const noexcept { return y_; }
    [[nodiscard]] float space() const noexcept { return high_.y - y_ - margin; }
    [[nodiscard]] ImDrawList& list() noexcept { return *list_; }
    [[nodiscard]] const Fonts& fonts() const noexcept { return *fonts_; }

    /// Paints a small heading, with a value at its right.
    void heading(const std::string& text, const std::string& value = {});
    /// Paints a line of text, shortened to the width.
    void line(const std::string& text, ImU32 colour = theme::text, const std::string& value = {},
              ImU32 value_colour = theme::text);
    /// Paints a line in another font.
    void line_in(ImFont* font, const std::string& text, ImU32 colour);
    /// Paints text over several lines, at most `max_lines`, and leaves `spare` pixels at the right.
    void paragraph(const std::string& text, ImU32 colour, int max_lines = 4, ImFont* font = nullptr,
                   float spare = 0.0f);
    /// Paints a horizontal bar, filled to a fraction.
    void bar(double fraction, ImU32 colour, float height = 8.0f);

private:
    ImDrawList* list_;
    const Fonts* fonts_;
    ImVec2 low_, high_;
    float y_;
};

/// Returns the height of a paragraph in a panel of this width, margins included; see PanelPainter::paragraph [pixels].
[[nodiscard]] float height_of_paragraph(ImFont* font, const std::string& text, float width, int max_lines);

/// A line of a plot.
struct PlotLine {
    std::vector<ImVec2> points;  ///< in the units of the axes
    ImU32 colour = theme::text;
};

/// Axes of a plot, and its dashed limits.
struct PlotAxes {
    float x_low = 0.0f, x_high = 1.0f, y_low = 0.0f, y_high = 1.0f;
    std::vector<float> limits{};
};

/// Paints a plot into a rectangle.
void paint_plot(ImDrawList& list, const Fonts& fonts, ImVec2 low, ImVec2 high, const PlotAxes& axes,
                const std::vector<PlotLine>& lines);

/// Returns a text shortened to a width, with "…".
[[nodiscard]] std::string shortened(ImFont* font, const std::string& text, float width);

}  // namespace kerf::window
