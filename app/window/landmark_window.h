// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "app/window/glfw_window.h"
#include "app/window/landmark_list.h"
#include "app/window/landmark_page.h"
#include "app/window/pixels.h"

namespace kerf::window {

/// Shows the landmark page until the user closes the window. `list` then has what was not written. Returns the reason
/// if the driver refuses to draw.   [main]
/// @param on_picture  called with a picture of the page that the user takes with F12
/// @param wants_end   returns whether to close
[[nodiscard]] std::string show_landmarks(GlfwWindow& window, LandmarkSource& source, LandmarkList& list,
                                         const std::function<void(const Pixels&)>& on_picture,
                                         const std::function<bool()>& wants_end);

/// Draws the landmark page once, without a window. Returns the reason if the driver refuses to draw.   [main]
/// @param side  from which the bone is seen, as LandmarkScreen::see_from takes it
[[nodiscard]] std::string draw_landmarks(LandmarkSource& source, LandmarkList& list, char side,
                                         const std::function<void(const Pixels&)>& on_picture);

}  // namespace kerf::window
