// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Curves with markers over two axes, as SVG. For training and research; not for diagnosis, planning or deciding
/// treatment.
namespace kerf::drawing {

struct Marker {
    double x = 0.0, y = 0.0;
    double x_most = 0.0;    ///< where its whisker ends; ≤ x: it has none
    double y_spread = 0.0;  ///< half the height of its error bar; 0: none
    bool is_filled = true;
    std::string label{};  ///< beside it
    std::string told{};   ///< when the pointer rests on it
};

struct Curve {
    std::string name{};  ///< at its last marker
    int colour = 0;      ///< 0 … colour_count − 1
    bool is_dashed = false;
    bool is_bold = false;
    bool has_line = true;
    bool has_dots = true;
    bool has_labels_below = false;
    std::vector<Marker> markers{};
};
inline constexpr int colour_count = 10;

struct Guide {
    double at = 0.0;
    std::string text{};
};

struct Axis {
    std::string title{};
    bool is_log = true;
    double low = 1.0, high = 10.0;  ///< low < high; both > 0 on a log axis
    std::vector<Guide> guides{};
};

struct Panel {
    std::string title{};
    Axis x{}, y{};
    std::vector<Curve> curves{};
    std::vector<Marker> front{};  ///< joined by a stair, markers left out; empty: none
};

/// Colours for light and dark: rules of classes that begin with `kp`.
[[nodiscard]] const char* plot_style();

/// A <g> of this size at this place [px]. Markers beyond an axis stand on its end, hollow.
[[nodiscard]] std::string panel_svg(const Panel& panel, double left, double top, double width, double height);

/// A marker of a curve's colour, for legends.
[[nodiscard]] std::string marker_svg(double x, double y, int colour, bool is_filled);

/// A whole picture: page, style, and what is drawn on it.
[[nodiscard]] std::string picture(double width, double height, const std::string& title, const std::string& content);

}  // namespace kerf::drawing
