// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/window/camera.h"
#include "app/window/gui.h"
#include "app/window/input.h"
#include "app/window/panels.h"
#include "app/window/scene_renderer.h"
#include "app/window/timeline.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// Pixels, row by row from the top, red, green and blue of each.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb{};
};

/// The picture and panels of a run. Draws into the framebuffer that is bound, whoever made its context.
class RunScreen {
public:
    /// Pre: a context of OpenGL 3.3 is current; `run` outlives this object. Throws std::runtime_error if the driver
    /// refuses.
    explicit RunScreen(run::ViewedRun& run);
    RunScreen(const RunScreen&) = delete;
    RunScreen& operator=(const RunScreen&) = delete;

    void take(const Input& input);
    /// Takes the newest of the run, and draws it.
    /// @param wall  [s] of any clock that runs evenly
    void draw(int width, int height, double wall);
    /// Returns what was drawn last.
    [[nodiscard]] Pixels pixels() const;
    [[nodiscard]] const run::ViewedState& state() const noexcept { return timeline_.state(); }
    [[nodiscard]] Timeline& timeline() noexcept { return timeline_; }
    [[nodiscard]] bool is_over() const { return run_->result().has_value(); }
    /// Returns whether a picture was requested since the last call.
    [[nodiscard]] bool takes_picture() noexcept { return std::exchange(takes_picture_, false); }
    [[nodiscard]] bool has_surface() const noexcept { return has_seen_surface_; }

private:
    void find_box(const run::ViewedSurface& surface, const run::ViewedState& state);
    void scrub(float x);
    [[nodiscard]] Layout layout() const;
    void see_from(char view);
    void take_key(const Input& input);
    void paint(const Layout& layout);

    run::ViewedRun* run_;
    Gui gui_;
    SceneRenderer renderer_;
    std::string renderer_name_;
    Camera camera_;
    ViewSettings settings_;
    Timeline timeline_;
    RealTimeFactor pace_;
    std::optional<run::ViewedResult> result_;
    std::int32_t framed_step_ = -1;  ///< step whose view the camera took
    bool is_free_ = false;           ///< the user has turned the view
    char view_ = '3';
    bool has_panels_ = true, shows_keys_ = false, shows_values_ = false, takes_picture_ = false;
    bool has_seen_surface_ = false;
    Vec3 middle_{};
    double radius_ = 0.05;  ///< [m] of the bone
    bool is_held_[3] = {false, false, false};
    bool is_scrubbing_ = false;
    float mouse_x_ = 0.0f, mouse_y_ = 0.0f;
    int width_ = 1, height_ = 1;
    double last_wall_ = -1.0, frame_time_ = 0.0;
};

}  // namespace kerf::window
