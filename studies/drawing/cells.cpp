// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/drawing/cells.h"

#include "studies/drawing/svg.h"

namespace kerf::drawing {

std::string cells_svg(const CellArea& area, const std::function<int(double x, double y)>& shade_at,
                      const std::function<std::string(int shade)>& fill_of) {
    std::string svg;
    for (double y = area.y_low; y < area.y_high; y += area.cell) {
        double begun = area.x_low;
        int shade = shade_at(begun, y);
        for (double x = begun; x <= area.x_high; x += area.cell) {
            const int now = x + area.cell > area.x_high ? -1 : shade_at(x, y);
            if (now == shade) continue;
            if (shade > 0)
                svg += "<rect x=\"" + px(area.px_of_x(begun)) + "\" y=\"" + px(area.px_of_y(y)) + "\" width=\"" +
                       px((x - begun) * area.pixels) + "\" height=\"" + px(area.cell * area.pixels + 0.3) +
                       "\" fill=\"" + fill_of(shade) + "\"/>\n";
            begun = x;
            shade = now;
        }
    }
    return svg;
}

}  // namespace kerf::drawing
