// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "app/window/glfw_window.h"
#include "app/window/pixels.h"
#include "app/window/start_page.h"

namespace kerf::window {

/// Shows the start page until the user chooses an action. Returns nothing if the user closed the window, or if
/// `is_ended` returns true. `error` gets the reason if the driver refuses to draw.   [main]
/// @param on_picture  called with a picture of the page that the user takes with F12
[[nodiscard]] std::optional<StartAction> show_start(GlfwWindow& window, StartSource& source, StartSelection& selection,
                                                    const std::function<void(const Pixels&)>& on_picture,
                                                    const std::function<bool()>& is_ended, std::string& error);

}  // namespace kerf::window
