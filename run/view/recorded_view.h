// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/view/viewed_run.h"

namespace kerf::run {

/// Shows a run from its session alone, without procedure, anatomy and plugins: the recorded poses, forces, events and
/// result over the bone of the end. All is read at once, so any time can be shown.   [main]
class RecordedView final : public ViewedRun {
public:
    /// Reads a session without changing it or its folder. Returns null if it cannot be shown; `error` is a text for
    /// people: not a session, another schema, damaged rows, or no tick.
    /// @param why  the reason for the view, as a clause for its note: "no procedure has its text"
    [[nodiscard]] static std::unique_ptr<RecordedView> read(const std::string& session, const std::string& why,
                                                            std::string& error);

    /// Closes the view once a function returns true.
    void close_if(std::function<bool()> is_closed) { is_closed_if_ = std::move(is_closed); }

    [[nodiscard]] const ViewedScene& scene() const noexcept override { return scene_; }
    bool take(ViewedState& state) noexcept override;
    void take(std::vector<ViewedRow>& rows) override;
    void take(std::vector<ViewedEvent>& events) override;
    void take(std::vector<ViewedMoment>& moments) override;
    void take(std::vector<std::shared_ptr<const ViewedRadiograph>>& radiographs) override;
    [[nodiscard]] std::shared_ptr<const ViewedRadiograph> radiograph() const override;
    [[nodiscard]] std::shared_ptr<const ViewedSurface> surface() const override { return surface_; }
    [[nodiscard]] std::optional<double> duration() const noexcept override;
    [[nodiscard]] std::string next_action() const override { return {}; }
    [[nodiscard]] std::optional<ViewedResult> result() const override { return result_; }
    [[nodiscard]] bool is_closed() const noexcept override { return is_closed_if_ && is_closed_if_(); }
    [[nodiscard]] bool is_led_by_mouse() const noexcept override { return false; }
    void lead(const MouseTotals& /*totals*/) noexcept override {}
    void stop() noexcept override {}

private:
    class Reader;
    RecordedView() = default;

    ViewedScene scene_;
    ViewedResult result_;
    std::shared_ptr<const ViewedSurface> surface_;  ///< may be null
    ViewedState last_;
    bool is_taken_ = false;
    std::vector<ViewedRow> rows_;        ///< until they are taken
    std::vector<ViewedEvent> events_;    ///< until they are taken
    std::vector<ViewedMoment> moments_;  ///< until they are taken
    std::vector<std::shared_ptr<const ViewedRadiograph>> radiographs_;
    std::size_t radiographs_taken_ = 0;
    std::function<bool()> is_closed_if_;
};

}  // namespace kerf::run
