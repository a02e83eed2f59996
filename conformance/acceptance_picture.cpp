// SPDX-License-Identifier: Apache-2.0
#include "conformance/acceptance_picture.h"

#include <algorithm>
#include <cstddef>

#include "studies/drawing/plot.h"

namespace kerf::conformance {

std::string difference_svg(const AcceptanceFile& recorded, const std::vector<AcceptanceRow>& found) {
    constexpr const char* titles[] = {"across, x [N]", "across, y [N]", "along the block's z [N]"};
    constexpr double width = 900.0, height = 240.0;
    std::string content = "<desc>For training and research; not for diagnosis, planning or deciding treatment</desc>\n";
    for (std::size_t i = 0; i < 3; ++i) {
        drawing::Panel panel;
        panel.title = std::string("Force of the bone on the tool ") + titles[i];
        drawing::Curve was{.name = "recorded", .colour = 0, .has_dots = false},
            is{.name = "found", .colour = 1, .is_dashed = true, .has_dots = false};
        double low = 0.0, high = 0.0;
        for (std::size_t r = 0; r < std::min(recorded.rows.size(), found.size()); ++r) {
            const double tick = static_cast<double>(recorded.rows[r].tick);
            was.markers.push_back({.x = tick, .y = (*recorded.rows[r].wrench)[i]});
            is.markers.push_back({.x = tick, .y = (*found[r].wrench)[i]});
            low = std::min({low, was.markers.back().y, is.markers.back().y});
            high = std::max({high, was.markers.back().y, is.markers.back().y});
        }
        const double margin = 0.05 * std::max(high - low, 0.1);
        panel.x = {.title = "tick", .is_log = false, .low = 0.0, .high = was.markers.back().x};
        panel.y = {.title = "N", .is_log = false, .low = low - margin, .high = high + margin};
        panel.curves = {was, is};
        content += drawing::panel_svg(panel, 0.0, static_cast<double>(i) * height, width, height);
    }
    return drawing::picture(width, 3.0 * height, "Recorded and found forces", content);
}

}  // namespace kerf::conformance
