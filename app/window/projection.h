// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <algorithm>
#include <optional>

#include "app/window/camera.h"

namespace kerf::window {

/// Where points of the world are in the picture. Pixels from the upper left corner of the window.
class Projection {
public:
    /// @param low,high  corners of the picture
    Projection(const Camera& camera, ImVec2 low, ImVec2 high)
        : low_(low),
          size_{high.x - low.x, high.y - low.y},
          metres_per_pixel_(camera.height_at_target() / std::max(1.0, static_cast<double>(high.y - low.y))),
          clip_from_world_(camera.clip_from_view(static_cast<double>(high.x - low.x) /
                                                 std::max(1.0, static_cast<double>(high.y - low.y))) *
                           camera.view_from_world()) {}

    /// Returns the pixel of a point; nothing if it is behind the eye.
    [[nodiscard]] std::optional<ImVec2> at(Vec3 point_in_world) const {
        const glm::vec4 clip = clip_from_world_ * glm::vec4(single(point_in_world), 1.0f);
        if (clip.w <= 0.0f) return std::nullopt;
        return ImVec2{low_.x + (0.5f + 0.5f * clip.x / clip.w) * size_.x,
                      low_.y + (0.5f - 0.5f * clip.y / clip.w) * size_.y};
    }
    /// Returns the length that a pixel covers at the camera's target [m].
    [[nodiscard]] double metres_per_pixel() const noexcept { return metres_per_pixel_; }

private:
    ImVec2 low_, size_;
    double metres_per_pixel_;
    glm::mat4 clip_from_world_;
};

}  // namespace kerf::window
