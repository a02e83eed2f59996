// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::drawing {

/// A section drawn in cells: x to the right, y down [m], from `x_low`, `y_low` to `x_high`, `y_high`.
struct CellArea {
    double x_low, x_high, y_low, y_high;  ///< [m]
    double cell;                          ///< [m]
    double left, top;                     ///< [px] where x_low and y_low are
    double pixels;                        ///< [px/m]

    [[nodiscard]] double px_of_x(double x) const { return left + (x - x_low) * pixels; }
    [[nodiscard]] double px_of_y(double y) const { return top + (y - y_low) * pixels; }
};

/// Returns the cells as rectangles: in each row, neighbours of one shade are one rectangle.
/// @param shade_at   of a cell at x, y [m]; 0: nothing is drawn
/// @param fill_of    of a shade, as an SVG colour
[[nodiscard]] std::string cells_svg(const CellArea& area, const std::function<int(double x, double y)>& shade_at,
                                    const std::function<std::string(int shade)>& fill_of);

}  // namespace kerf::drawing
