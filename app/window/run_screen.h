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
#include "app/window/inspection_view.h"
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
    /// Shows these layers of the law's inspection, and follows the tip from near. An examination has none.
    void inspect(const InspectionLayers& layers);
    /// Sets the buttons of the card with the result.
    void set_buttons(const CardButtons& buttons) { buttons_ = buttons; }
    /// Returns the action that the user has chosen on that card since the last call, if it leaves this screen.
    [[nodiscard]] std::optional<CardAction> take_action() noexcept { return std::exchange(action_, std::nullopt); }
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
    /// Returns the state of mouse and keys.
    [[nodiscard]] const MouseLead& lead() const noexcept { return lead_; }
    /// Returns what their next input refers to: camera, tool and tissue.
    [[nodiscard]] LeadContext lead_context() const;

private:
    void find_box(const run::ViewedSurface& surface, const run::ViewedState& state);
    void begin_view(const Sphere& bone);
    void scrub(float x);
    [[nodiscard]] Layout layout() const;
    void see_from(char view);
    [[nodiscard]] bool is_led() const;
    [[nodiscard]] bool may_rewind() const;
    [[nodiscard]] bool is_refused_pause(const Input& input) const;
    void take_view(const Input& input);
    void paint_push(const Projection& projection) const;
    void take_key(const Input& input);
    [[nodiscard]] bool take_card_key(int key);
    void act(const CardAction& action);
    void choose_deduction(int step);
    [[nodiscard]] bool is_card_open() const;
    [[nodiscard]] double debrief_time() const;
    [[nodiscard]] CardModel card_model() const;
    void request_radiograph();
    [[nodiscard]] RadiographModel radiograph_model();
    void paint(const Layout& layout);

    run::ViewedRun* run_;
    Gui gui_;
    SceneRenderer renderer_;
    std::string renderer_name_;
    Camera camera_;
    ViewSettings settings_;
    Timeline timeline_;
    RealTimeFactor pace_;
    MouseLead lead_;
    RadiographTexture radiograph_;
    InspectionView inspection_;
    InspectionLayers layers_;
    std::size_t arm_ = 0;  ///< position of the C-arm for the next radiograph
    std::optional<run::ViewedResult> result_;
    std::int32_t framed_step_ = -1;  ///< step whose view the camera took
    bool is_free_ = false;           ///< the user has turned the view
    bool follows_tip_ = false;
    char view_ = '3';
    bool has_panels_ = true, shows_keys_ = false, shows_values_ = false, takes_picture_ = false;
    bool has_seen_surface_ = false;
    Sphere bone_;
    bool is_held_[3] = {false, false, false};
    bool is_scrubbing_ = false;
    std::vector<CardLink> links_;  ///< of the last picture
    CardButtons buttons_;
    bool is_card_open_at_end_ = true, is_card_open_earlier_ = false;
    std::optional<std::size_t> deduction_;  ///< chosen by keys
    std::optional<CardAction> action_;      ///< chosen, and not yet taken
    float mouse_x_ = 0.0f, mouse_y_ = 0.0f;
    int width_ = 1, height_ = 1;
    double last_wall_ = -1.0, frame_time_ = 0.0;
};

}  // namespace kerf::window
