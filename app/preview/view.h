// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/preview/png.h"
#include "run/scene.h"

/// Pictures of a scene before anything is cut.
namespace kerf {

/// A rectangle in the patient, seen without perspective. Frame: LPS, metres.
struct View {
    std::string title;
    Vec3 centre{};
    Vec3 right{}, up{};  ///< unit, at right angles: along the picture
    double width = 0.1;  ///< [m] of the rectangle
    int columns = 460, rows = 400;

    [[nodiscard]] Vec3 away() const noexcept { return cross(up, right); }    ///< unit, from the eye into the picture
    [[nodiscard]] double pixel() const noexcept { return width / columns; }  ///< [m]
    [[nodiscard]] Vec3 place(double x, double y) const noexcept {
        return centre + (x - 0.5 * columns) * pixel() * right + (0.5 * rows - y) * pixel() * up;
    }
    [[nodiscard]] double x_of(Vec3 p) const noexcept { return 0.5 * columns + dot(p - centre, right) / pixel(); }
    [[nodiscard]] double y_of(Vec3 p) const noexcept { return 0.5 * rows - dot(p - centre, up) / pixel(); }
};

/// Returns the bone of the plan: of a fractured one before it broke.   [any]
[[nodiscard]] const Body& planned_bone(const Scene& scene) noexcept;

/// The whole region from outside: bone, zones red and tools blue, implants grey, a fragment brown where it lies now,
/// all paler where bone hides them. `tools`: where each step's tool is. [main]
[[nodiscard]] Picture from_outside(const View& view, const Scene& scene, const std::vector<Pose>& tools);

/// A cut through the plane of the view: the scan's values where there is one, tissues in their colours, zones red, the
/// border of bone as a line.   [main]
[[nodiscard]] Picture cut_through(const View& view, const Scene& scene);

}  // namespace kerf
