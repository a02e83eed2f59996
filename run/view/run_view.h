// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "documents/hand_input.h"
#include "kerf/newest.hpp"
#include "run/run_observer.h"
#include "run/scene.h"
#include "run/view/inspection.h"
#include "run/view/radiograph_worker.h"
#include "run/view/scene_view.h"
#include "run/view/surface_view.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

/// Shows a run to a viewer on another thread, while it runs, live or as a replay. It is an observer of the run: give it
/// to the request. The haptic thread does nothing for it; the thread that follows the loop makes states and surfaces.
class RunView final : public RunObserver, public ViewedRun {
public:
    /// Pre: `scene` outlives this object.   [main]
    /// @param duration  [s] of a replay; nothing: a live run
    RunView(const Scene& scene, const ViewedSetting& setting, std::optional<double> duration = {});
    ~RunView() override;

    // Called on the run's thread.
    void on_begin(Run& run) override;
    void on_event(const session::EventRow& event) override;
    void on_tick(const session::TickRow& row) override;
    [[nodiscard]] std::optional<RunEnd> end() override;
    [[nodiscard]] std::string on_result(const session::RunSummary& summary, const Simulation& simulation) override;

    /// Lets the viewer's mouse lead the tool. `box` must outlive this object.   [main] before the first tick
    /// @param is_interrupted  whether the run is to end, called on the viewer's thread: a paused run continues then
    void let_mouse_lead(MouseBox& box, std::function<bool()> is_interrupted = {}) {
        mouse_ = &box;
        is_interrupted_ = std::move(is_interrupted);
    }
    /// Lets the viewer close.   [any]
    void close() noexcept { is_closed_ = true; }

    // Called on the viewer's thread.
    [[nodiscard]] const ViewedScene& scene() const noexcept override { return viewed_; }
    bool take(ViewedState& state) noexcept override;
    void take(std::vector<ViewedRow>& rows) override;
    void take(std::vector<ViewedEvent>& events) override;
    void take(std::vector<ViewedMoment>& moments) override;
    void take(std::vector<std::shared_ptr<const ViewedRadiograph>>& radiographs) override;
    [[nodiscard]] std::shared_ptr<const ViewedRadiograph> radiograph() const override;
    void request_radiograph(double about_head_axis, double tilt) override;
    void request_help() override;
    void request_inspection(bool is_wanted) noexcept override { is_inspecting_ = is_wanted && !viewed_.is_examination; }
    [[nodiscard]] std::optional<double> duration() const noexcept override { return duration_; }
    [[nodiscard]] std::shared_ptr<const ViewedSurface> surface() const override;
    [[nodiscard]] std::string next_action() const override;
    [[nodiscard]] std::optional<ViewedResult> result() const override;
    [[nodiscard]] bool is_led_by_mouse() const noexcept override { return mouse_ != nullptr; }
    void lead(const MouseTotals& totals) noexcept override;
    [[nodiscard]] bool is_closed() const noexcept override { return is_closed_; }
    void stop() noexcept override;

private:
    void show_bodies();
    void show_surface();
    void show_zone();
    [[nodiscard]] bool is_shown(const documents::ZoneDisplay& display, double distance) const;
    void show_step();
    void show_moment();
    void show_tick(const session::TickRow& row);
    void add_cortex(std::int32_t tissue);
    void pass_requests_on();
    [[nodiscard]] std::string translated(std::string text) const;
    void take_radiograph(double time);

    const Scene* scene_;
    ViewedScene viewed_;
    std::string folder_, language_;
    std::optional<double> duration_;
    std::atomic<bool> should_stop_{false}, is_closed_{false}, is_image_wanted_{false}, is_help_wanted_{false},
        is_inspecting_{false};
    Newest<ViewedState> newest_;

    MouseBox* mouse_ = nullptr;

    // Of the run's thread.
    Run* run_ = nullptr;
    SurfaceView surfaces_;
    ViewedState state_;
    std::vector<ViewedRow> new_rows_;               ///< that the viewer cannot take yet
    std::vector<documents::ZoneDisplay> displays_;  ///< of the zones
    std::vector<std::int32_t> cortical_;            ///< indices of the tissues that count as cortex
    bool was_in_cortex_ = false;
    documents::HandInput image_;  ///< the last one that was requested
    Inspector inspector_;
    std::shared_ptr<const ViewedInspection> inspection_;  ///< of the next moment; null: none is wanted

    // Of the viewer's thread.
    std::uint64_t seen_ = 0;  ///< number of the state taken last
    MouseTotals totals_;      ///< put last
    std::function<bool()> is_interrupted_;

    mutable std::mutex mutex_;  ///< guards the members below
    std::shared_ptr<const ViewedSurface> surface_;
    std::vector<ViewedEvent> events_;
    std::vector<ViewedRow> rows_;
    std::vector<ViewedMoment> moments_;
    std::string next_action_;
    std::optional<ViewedResult> result_;
    documents::HandInput wanted_image_;
    std::vector<std::shared_ptr<const ViewedRadiograph>> radiographs_;
    std::shared_ptr<const ViewedRadiograph> radiograph_;

    RadiographWorker radiograph_worker_;  ///< the last member: its thread ends first
};

}  // namespace kerf::run
