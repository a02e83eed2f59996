// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/window/camera.h"
#include "app/window/landmark_page.h"
#include "app/window/theme.h"

namespace kerf::window {

/// The part of a page that shows the bone, in pixels from the upper left corner.
struct PictureArea {
    float left = 0.0f, top = 0.0f, right = 1.0f, bottom = 1.0f;

    [[nodiscard]] double aspect() const noexcept {
        return static_cast<double>(right - left) / static_cast<double>(bottom - top);
    }
    [[nodiscard]] bool contains(float x, float y) const noexcept {
        return x > left && x < right && y > top && y < bottom;
    }
    /// Returns the unit direction from the eye through a pixel.
    [[nodiscard]] Vec3 direction_at(const Camera& camera, float x, float y) const;
    /// Returns the pixel that shows a point; nothing if it is not before the eye.
    [[nodiscard]] std::optional<ImVec2> pixel_of(const Camera& camera, Vec3 point) const;
};

/// Landmarks as they are painted over the picture of the bone: solid where they are seen, faint where bone hides them.
class LandmarkOverlay {
public:
    /// Finds where landmarks appear and what hides them.
    void update(const Camera& camera, const PictureArea& area, const LandmarkSource& source,
                const std::vector<PickedLandmark>& picked);
    void paint(ImDrawList& list, const Fonts& fonts, const PictureArea& area,
               std::optional<std::size_t> selected) const;

    /// An end of a picked landmark.
    struct End {
        std::size_t index = 0;
        bool is_end = false;  ///< where an axis ends; else its beginning, or the point
    };
    /// Returns the end of a picked landmark at a pixel; nothing if there is none, or bone hides it.
    [[nodiscard]] std::optional<End> end_at(float x, float y) const;

private:
    struct Spot {
        ImVec2 at{};
        bool is_before_eye = false, is_seen = false;
    };
    struct Mark {
        std::string words;
        std::vector<Spot> spots;  ///< one for a point; along an axis from its beginning
    };
    [[nodiscard]] static Mark mark_of(const PickedLandmark& landmark, const Camera& camera, const PictureArea& area,
                                      const LandmarkSource& source);
    static void paint_mark(const Mark& mark, ImU32 colour, float size, ImDrawList& list, const Fonts& fonts);

    std::vector<Mark> written_, picked_;
};

}  // namespace kerf::window
