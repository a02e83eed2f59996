// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "session/drawn_surface.h"
#include "session/recording.h"

/// Selects the parts of a run that its page shows. Ticks and events arrive one at a time, so memory does not grow with
/// the run.
namespace kerf::session {

/// Selects at most `most` of `total` rows: all of them if they are few. Else it selects the minimum and maximum of
/// thrust, torque, lateral force and depth in every stretch of time, and the first and last row.   [any]
class Thinning {
public:
    Thinning(std::uint64_t total, std::size_t most);

    /// Adds the next row. Rows beyond `total` are left out.
    void add(const TickRow& row);
    /// Returns the rows selected so far, in order.
    [[nodiscard]] std::vector<TickRow> rows() const;

private:
    static constexpr std::size_t quantities = 4;
    struct Extreme {
        std::uint64_t index = 0;
        double value = 0.0;
        TickRow row;
    };
    using Picked = std::vector<std::pair<std::uint64_t, TickRow>>;

    void end_stretch(Picked& picked, bool with_last) const;

    std::uint64_t total_, stretches_, next_ = 0, stretch_ = 0, stretch_end_ = 0;
    bool is_whole_;
    Picked picked_;
    std::vector<Extreme> minima_, maxima_;  ///< of this stretch, one per quantity; empty before its first row
    TickRow last_;
};

/// The part of a run that its page shows.
class DrawnRun {
public:
    static constexpr std::size_t max_plotted = 20'000, max_events = 2'000;

    /// @param total   number of ticks that will be added
    explicit DrawnRun(std::uint64_t total = 0) : plotted_(total, max_plotted) {}

    /// Sets the number of ticks that will be added. Pre: no tick was added.
    void expect(std::uint64_t total);
    void add(const TickRow& row);
    void add(EventRow event);
    void set_bone(DrawnSurface bone) { bone_ = std::move(bone); }

    [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
    [[nodiscard]] const std::optional<TickRow>& last() const noexcept { return last_; }
    /// The first one, if several.
    [[nodiscard]] const std::optional<TickRow>& deepest() const noexcept { return deepest_; }
    [[nodiscard]] std::vector<TickRow> plotted() const { return plotted_.rows(); }
    /// Returns whether bone acted on the tool in a step, or metal.
    [[nodiscard]] bool has_met_bone(std::size_t step) const noexcept { return step < met_.size() && met_[step]; }
    [[nodiscard]] const std::vector<EventRow>& events() const noexcept { return events_; }  ///< the first max_events
    [[nodiscard]] std::uint64_t event_count() const noexcept { return event_count_; }
    [[nodiscard]] const DrawnSurface& bone() const noexcept { return bone_; }

private:
    Thinning plotted_;
    std::vector<bool> met_;  ///< by step
    std::uint64_t ticks_ = 0, event_count_ = 0;
    std::optional<TickRow> last_, deepest_;
    std::vector<EventRow> events_;
    DrawnSurface bone_;
};

/// Returns the force across the shaft [N]: the modelled force without its part along the tool's axis.   [any]
[[nodiscard]] double lateral_force(const TickRow& row) noexcept;
/// Returns the torque on the hand about the handle's z axis that was sent to the device [N·m], device newtons.   [any]
[[nodiscard]] double sent_torque(const TickRow& row) noexcept;

}  // namespace kerf::session
