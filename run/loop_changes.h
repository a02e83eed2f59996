// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/haptics/scene/simulation.h"

namespace kerf::run {

struct LoopLink;

/// A change that a loop on the clock took over later than a run in lock-step makes it, or refused.
struct LateChange {
    std::uint64_t number = 0;  ///< of all changes of the run, from 1 on
    std::uint64_t tick = 0;    ///< the tick before which it was taken over
    bool is_refused = false;
};

/// The changes of a run's loop between two ticks: its tool, its sleeve, its bodies.
///
/// In lock-step each is made at once. A loop on the clock runs ahead of the run, so a change is prepared, posted to the
/// loop and made here when the loop has taken it over. One is posted at a time; what is decided meanwhile goes into the
/// next. A replay of such a run makes each before the tick that it recorded.
class LoopChanges {
public:
    /// Pre: `simulation` outlives this object.
    explicit LoopChanges(Simulation& simulation) : simulation_(&simulation) {}
    /// Begins a replay of a run on the clock, if changes came late in it.
    void begin_replay(std::vector<LateChange> late);
    /// Begins to follow a loop. Pre: `link` outlives this object.
    void begin_following(LoopLink& link);
    /// Lets the followed loop take over changes and separations when that of a recorded run did, for a number of ticks.
    /// Pre: it has just begun to follow.
    void repeat(std::vector<LateChange> late, std::vector<std::uint64_t> adoptions, std::uint64_t ticks);

    [[nodiscard]] bool is_in_lock_step() const noexcept { return mode_ == Mode::lock_step; }
    [[nodiscard]] bool is_following() const noexcept { return mode_ == Mode::following; }
    /// Returns whether a change of bodies may be prepared now.
    [[nodiscard]] bool is_free() const noexcept {
        return is_in_lock_step() || (!posted_ && !next_.removes_held && simulation_->is_ready_for_change());
    }

    // Decisions. In lock-step they are made at once.
    void lead(const std::optional<Guide>& guide);
    void take_tool(std::size_t tool, double back);
    void remove_held();
    /// Notes that the change of bodies that was just prepared comes later than in lock-step, whenever it is made.
    void delay() noexcept { next_.is_delayed = true; }

    /// Posts what was decided, if the last change is made. Does nothing in lock-step.
    /// @param step  of the procedure that runs from then on
    void post(std::size_t step);
    struct Due {
        bool is_refused = false;
    };
    /// Returns what a replayed loop does with the posted change before the next tick. Nothing: it waits, none is
    /// posted, or a loop on the clock has to report it.
    [[nodiscard]] std::optional<Due> due() const;

    /// What was made.
    struct Made {
        std::uint64_t number = 0;
        bool is_late = false, is_refused = false, has_closed_stretches = false;
        std::optional<std::size_t> tool;
    };
    /// Makes the posted change here, before the next tick, or drops it if the loop refused it or it is impossible. Pre:
    /// one is posted.
    Made make(bool is_refused);
    /// Posts the change again with a new offer.
    void renew();
    /// Posts the first separation that waits, if none is posted. With `now`, the loop takes it over after its next
    /// tick.
    void post_separation(bool now);
    /// Notes that the loop has taken over the posted separation after the coming tick.
    void adopt();
    /// Notes that the posted separation needs a new offer.
    void renew_separation();

    /// Returns whether a tool was decided and is not yet in hand.
    [[nodiscard]] bool awaits_tool() const noexcept { return next_.tool || (posted_ && posted_->tool); }
    [[nodiscard]] bool is_posted() const noexcept { return posted_.has_value(); }
    /// Shows the loop on the clock whether changes wait for an earlier one, or a step for its tool.
    void show_busy(bool is_waiting) noexcept;
    /// Forgets the tool that was decided and not yet taken: the run has ended.
    void drop_tool() noexcept;

private:
    enum class Mode { lock_step, replay, following };
    struct Decided {
        std::optional<std::optional<Guide>> guide;
        bool removes_held = false, is_delayed = false, changes_bodies = false;
        std::optional<std::size_t> tool;
        double back = 0.0;

        [[nodiscard]] bool is_any() const noexcept { return guide || removes_held || tool; }
    };
    [[nodiscard]] bool is_late() const noexcept { return posted_->is_delayed || simulation_->ticks() != posted_at_; }
    void post_to_loop();
    [[nodiscard]] const LateChange* late() const noexcept;
    [[nodiscard]] std::uint64_t separation_due(const Separation& waiting, bool now) const noexcept;

    Simulation* simulation_;
    Mode mode_ = Mode::lock_step;
    LoopLink* link_ = nullptr;
    std::vector<LateChange> late_;               ///< of the replayed run, or of that with which this one begins
    std::vector<std::uint64_t> adoptions_;       ///< of the run with which this one begins, as Simulation takes them
    std::optional<std::optional<Guide>> guide_;  ///< last decided; no value: none was
    Decided next_;
    std::optional<Decided> posted_;
    std::uint64_t posted_at_ = 0;  ///< [ticks]
    std::size_t step_ = 0;         ///< posted with it
    std::uint64_t number_ = 0;     ///< of the posted change
    bool is_separation_posted_ = false;
    std::uint64_t adopted_ = 0;  ///< number of separations that were made
    std::uint64_t made_ = 0;     ///< number of changes that were made
};

}  // namespace kerf::run
