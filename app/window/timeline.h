// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "run/view/viewed_run.h"

namespace kerf::window {

/// All that a window has seen of a run, and the time that it shows: the newest, or one that the user has chosen.
class Timeline {
public:
    static constexpr double plot_span = 5.0;                ///< [s] of the force plot
    static constexpr std::size_t max_inspections = 20'000;  ///< moments, about five minutes, that keep theirs

    /// Takes what is new of the run, and plays on.
    /// @param passed  [s] on the wall since the last call
    void take(run::ViewedRun& run, double passed);

    /// Shows the newest state from now on.
    void follow() noexcept { is_following_ = true; }
    /// Shows the state at a time [s], and stays there. A time that is still to come is shown when it has.
    void show_at(double time);
    /// Moves by a number of moments, of 16 ms each.
    void step(int moments);
    /// Starts or stops to play from the shown time.
    void play(bool plays) noexcept;
    /// Multiplies the speed of playing, within 1/8 to 8.
    void change_speed(double factor) noexcept;

    [[nodiscard]] bool is_following() const noexcept { return is_following_; }
    [[nodiscard]] bool is_playing() const noexcept { return is_playing_; }
    [[nodiscard]] double speed() const noexcept { return speed_; }
    [[nodiscard]] const run::ViewedState& state() const noexcept;
    [[nodiscard]] const std::shared_ptr<const run::ViewedSurface>& surface() const noexcept;
    /// Returns the inspection at the shown time; null: none was requested, or it is more than `max_inspections` old.
    [[nodiscard]] std::shared_ptr<const run::ViewedInspection> inspection() const noexcept;
    /// Returns the last radiograph taken up to the shown time; null: there is none, or it is not yet made.
    [[nodiscard]] std::shared_ptr<const run::ViewedRadiograph> radiograph() const noexcept;
    /// Returns whether that radiograph is made, or none was taken.
    [[nodiscard]] bool has_radiograph() const noexcept { return radiographs_.size() >= state().shots; }
    /// Returns the time of the newest state [s].
    [[nodiscard]] double newest() const noexcept { return newest_.time; }

    /// Rows of the last seconds before the shown time, oldest first.
    [[nodiscard]] std::span<const run::ViewedRow> recent() const;
    /// Torque over turns in the running step, up to the shown time.
    struct Turn {
        double time;           ///< [s]
        float turned, torque;  ///< [rad], [N·m]
        std::int32_t step;
    };
    [[nodiscard]] std::span<const Turn> turns() const;
    [[nodiscard]] const std::vector<run::ViewedEvent>& events() const noexcept { return events_; }

private:
    void take_rows(run::ViewedRun& run);
    void find_shown();
    void drop_inspections();

    run::ViewedState newest_;
    std::shared_ptr<const run::ViewedSurface> newest_surface_;
    std::vector<run::ViewedMoment> moments_;
    std::vector<run::ViewedRow> rows_;
    std::vector<Turn> turns_;
    std::vector<run::ViewedEvent> events_;
    std::vector<std::shared_ptr<const run::ViewedRadiograph>> radiographs_;  ///< by number
    bool is_following_ = true, is_playing_ = false;
    double speed_ = 1.0, shown_time_ = 0.0;
    std::size_t shown_ = 0;    ///< index into `moments_`
    std::size_t dropped_ = 0;  ///< number of moments without their inspections
};

/// Measures how fast a run passes compared with the wall, over about a second.
class RealTimeFactor {
public:
    /// @param wall  [s] of any clock that runs evenly
    void show(double simulated, double wall);
    [[nodiscard]] double value() const noexcept { return value_; }

private:
    double from_simulated_ = 0.0, from_wall_ = -1.0, value_ = 1.0;
};

}  // namespace kerf::window
