// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/preview/png.h"
#include "run/scene.h"

/// Pictures of a scene before it is cut.
namespace kerf::app {

/// A rectangle in the patient, in parallel projection. Frame: LPS, metres.
struct View {
    std::string title;
    Vec3 centre{};
    Vec3 right{}, up{};  ///< orthogonal unit vectors in the picture
    double width = 0.1;  ///< [m] of the rectangle
    int columns = 460, rows = 400;

    [[nodiscard]] Vec3 away() const noexcept { return cross(up, right); }    ///< unit, from the eye into the picture
    [[nodiscard]] double pixel() const noexcept { return width / columns; }  ///< [m]
    [[nodiscard]] Vec3 point(double x, double y) const noexcept {
        return centre + (x - 0.5 * columns) * pixel() * right + (0.5 * rows - y) * pixel() * up;
    }
    [[nodiscard]] double x_of(Vec3 p) const noexcept { return 0.5 * columns + dot(p - centre, right) / pixel(); }
    [[nodiscard]] double y_of(Vec3 p) const noexcept { return 0.5 * rows - dot(p - centre, up) / pixel(); }
};

/// Returns the bone of the plan; if it is fractured, as it was before the fracture.   [any]
[[nodiscard]] const Body& planned_bone(const run::Scene& scene) noexcept;

/// Draws the whole region from outside: bone, zones red, tools blue, implants grey, and a fragment brown at its present
/// pose. Parts behind bone are paler.   [main]
/// @param tools   world_from_tool of each step
[[nodiscard]] Picture from_outside(const View& view, const run::Scene& scene, const std::vector<Pose>& tools);

/// Draws the section in the plane of the view: the values of the scan if there is one, tissues in their colours, zones
/// red, and the border of bone as a line.   [main]
[[nodiscard]] Picture cut_through(const View& view, const run::Scene& scene);

}  // namespace kerf::app
