// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/window/end_card.h"
#include "app/window/inspection_view.h"
#include "app/window/mouse_lead.h"
#include "app/window/scene_renderer.h"
#include "app/window/theme.h"
#include "app/window/timeline.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// What the panels show of radiographs.
struct RadiographModel {
    std::shared_ptr<const run::ViewedRadiograph> radiograph{};  ///< null: none was taken
    unsigned texture = 0;                                       ///< with its pixels; 0: there are none
    std::string arm{};  ///< position of the C-arm for the next one, in words; empty: none can be taken
};

/// All that the panels show of a run at one moment.
struct PanelModel {
    const run::ViewedScene* scene = nullptr;
    const run::ViewedState* state = nullptr;
    const Timeline* timeline = nullptr;
    std::optional<double> duration{};  ///< [s] of a replay
    CardModel card{};
    RadiographModel radiograph{};
    std::string next_action{};
    std::string renderer{};  ///< empty: a graphics card draws
    double real_time_factor = 1.0;
    double frame_time = 0.0;          ///< [s] of the window
    const MouseLead* lead = nullptr;  ///< null: no mouse leads the tool
    InspectionLayers layers{};
    std::shared_ptr<const run::ViewedInspection> inspection{};  ///< null: there is none at this time
    bool shows_keys = false, shows_values = false;
    std::size_t triangles = 0;
};

/// The places of the panels in a window, in pixels from the upper left corner.
struct Layout {
    static constexpr float min_width = 760.0f, min_height = 420.0f;
    static constexpr float top = 38.0f, bottom = 40.0f, left = 236.0f, right = 292.0f, header = 46.0f;
    float width = 0.0f, height = 0.0f;
    bool has_panels = true;

    [[nodiscard]] ImVec2 picture_low() const noexcept {
        return has_panels ? ImVec2{left, top + header} : ImVec2{0.0f, 0.0f};
    }
    [[nodiscard]] ImVec2 picture_high() const noexcept {
        return has_panels ? ImVec2{width - right, height - bottom} : ImVec2{width, height};
    }
    /// Returns the ends of the time line along x.
    [[nodiscard]] float line_from() const noexcept { return 96.0f; }
    [[nodiscard]] float line_to() const noexcept { return width - 80.0f; }
    /// Returns whether the panels fit.
    [[nodiscard]] static bool fits(float width, float height) noexcept {
        return width >= min_width && height >= min_height;
    }
};

/// Paints all panels into ImGui's background. Returns what can be clicked. Pre: a frame of ImGui has begun.
std::vector<CardLink> paint_panels(const PanelModel& model, const Layout& layout, const Fonts& fonts);

/// Returns the length of the time line [s].
[[nodiscard]] double line_span(const Timeline& timeline, const std::optional<double>& duration);

/// A key and what it does, as F1 lists it.
struct KeyHelp {
    const char* key;
    const char* words;
};
/// Returns the keys that do something now.
[[nodiscard]] std::vector<KeyHelp> key_help(const PanelModel& model);

}  // namespace kerf::window
