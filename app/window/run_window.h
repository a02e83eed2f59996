// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/window/glfw_window.h"
#include "app/window/run_screen.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

struct WindowRequest {
    /// Called with a picture of the window, the time of the run [s], and whether it is the one after the result.
    std::function<void(const Pixels&, double, bool)> on_picture{};
    std::optional<double> begins_at{};  ///< [s] plays from there; nothing: shows the newest state
    bool closes_at_end = false;         ///< takes a picture after the result, and closes
    bool is_inspecting = false;         ///< begins with all layers of the law's inspection
    bool has_start_page = false;        ///< the card leads back to it
    bool has_again = false, has_debrief = false, has_resume = false;  ///< buttons of the card
    std::function<void(const CardAction&)> on_leave{};  ///< called with the action of the card that ends the display
};

/// Prepares the process for a window; to be called before another thread starts. On a software renderer the memory of
/// freed frames is kept, which makes frames four times as fast.   [main]
void prepare_process();

/// Shows a bar while other threads work. Returns false if the user closed the window meanwhile.   [main]
/// @param fraction  of the work that is done, 0 … 1 [–]
bool show_waiting(GlfwWindow& window, const std::string& what, const std::function<double()>& fraction,
                  const std::function<bool()>& is_done);

/// Shows a run until the user closes the window. Closing it during a run ends the run and shows the card; closing it
/// again returns. A replay, or a run with `closes_at_end`, returns at the first. Returns the reason if the driver
/// refuses to draw; then the run was not ended.   [main]
[[nodiscard]] std::string show_run(GlfwWindow& window, run::ViewedRun& run, const WindowRequest& request);

/// Draws a run at these times [s], ascending, without a window, and calls `on_picture` with each. A time after the end
/// shows the end. Returns the reason if the driver refuses to draw.   [main]
/// @param is_inspecting  whether the pictures have all layers of the law's inspection
[[nodiscard]] std::string draw_run(run::ViewedRun& run, const std::function<std::optional<double>()>& next_time,
                                   const std::function<void(const Pixels&, double)>& on_picture, bool is_inspecting);

}  // namespace kerf::window
