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
#include "app/window/mouse_lead.h"
#include "app/window/panels.h"
#include "app/window/pixels.h"
#include "app/window/radiograph_texture.h"
#include "app/window/scene_renderer.h"
#include "app/window/step_view.h"
#include "app/window/timeline.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// The picture and panels of a run. Draws into the framebuffer that is bound.
class RunScreen {
public:
    /// Pre: a context of OpenGL 3.3 is current; `run` outlives this object. Throws std::runtime_error if the driver
    /// refuses.
    explicit RunScreen(run::ViewedRun& run);
    RunScreen(const RunScreen&) = delete;
    RunScreen& operator=(const RunScreen&) = delete;

    void take(const Input& input);
    /// Sets the words below the result about leaving it.
    void set_exit_hint(std::string words) { exit_hint_ = std::move(words); }
    /// Takes the newest of the run, and gives it what mouse and keys have done.
    /// @param wall  [s] of any clock that runs evenly
    void update(double wall);
    /// Updates, and draws.
    void draw(int width, int height, double wall);
    /// Returns what was drawn last.
    [[nodiscard]] Pixels pixels() const { return read_pixels(width_, height_); }
    [[nodiscard]] const run::ViewedState& state() const noexcept { return timeline_.state(); }
    [[nodiscard]] Timeline& timeline() noexcept { return timeline_; }
    [[nodiscard]] bool is_over() const { return run_->result().has_value(); }
    /// Returns whether a picture was requested since the last call.
    [[nodiscard]] bool takes_picture() noexcept { return std::exchange(takes_picture_, false); }
    /// Returns whether the mouse grips the tool.
    [[nodiscard]] bool captures_cursor() const { return is_led() && lead_.is_gripping(); }
    [[nodiscard]] bool has_surface() const noexcept { return has_seen_surface_; }

private:
    void find_box(const run::ViewedSurface& surface, const run::ViewedState& state);
    void scrub(float x);
    [[nodiscard]] Layout layout() const;
    void see_from(char view);
    [[nodiscard]] bool is_led() const;
    [[nodiscard]] bool may_rewind() const;
    [[nodiscard]] bool is_refused_pause(const Input& input) const;
    [[nodiscard]] LeadContext lead_context() const;
    void take_view(const Input& input);
    void paint_push(const Layout& layout, const Fonts& fonts) const;
    void take_key(const Input& input);
    void request_radiograph();
    [[nodiscard]] RadiographModel radiograph_model();
    void paint(const Layout& layout);

    run::ViewedRun* run_;
    Gui gui_;
    SceneRenderer renderer_;
    std::string renderer_name_, exit_hint_;
    Camera camera_;
    ViewSettings settings_;
    Timeline timeline_;
    RealTimeFactor pace_;
    MouseLead lead_;
    RadiographTexture radiograph_;
    std::size_t arm_ = 0;  ///< position of the C-arm for the next radiograph
    std::optional<run::ViewedResult> result_;
    std::int32_t framed_step_ = -1;  ///< step whose view the camera took
    bool is_free_ = false;           ///< the user has turned the view
    char view_ = '3';
    bool has_panels_ = true, shows_keys_ = false, shows_values_ = false, takes_picture_ = false;
    bool has_seen_surface_ = false;
    Sphere bone_;
    bool is_held_[3] = {false, false, false};
    bool is_scrubbing_ = false;
    std::vector<TimeLink> links_;  ///< of the last picture
    float mouse_x_ = 0.0f, mouse_y_ = 0.0f;
    int width_ = 1, height_ = 1;
    double last_wall_ = -1.0, frame_time_ = 0.0;
};

}  // namespace kerf::window
