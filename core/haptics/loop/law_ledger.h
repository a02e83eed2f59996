// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/evaluate_law.h"
#include "core/haptics/loop/loop_tools.h"

namespace kerf {

/// What a law gave to the tool beyond what it had taken, over one second.
struct MadeEnergy {
    double made = 0.0;     ///< [J] ≥ 0
    double through = 0.0;  ///< [J] sum of all work that the law did or took, without sign
};

/// The balance of a law's energy. A law may give back what its springs store, and no more:
///
///     W ← min(W + Σ λ s T − w·u T, V),    V = Σ ½ k δ²,    made ← made − min(W, 0)
///
/// over its channels of contact and hold, with the rate s along each, and its own wrench and following loads w. The
/// ceiling V forgets what was spent on bone. The motor of a driven tool may move the hand by w, as far as bone carries
/// it: up to `carried` times the forces λ. What is beyond may only shake the hand, so its sum counts. Where a drive
/// changes, contact takes over from cutting or ends: for `settling`, W is V. After [hannaford-ryu-2002], as
/// PassivityGuard, with the law in the role of the loop.
class LawLedger {
public:
    /// Adds a step. Returns true at the end of the first second in which the law made energy: above `floor` and two
    /// fifths of the work through it, or by w alone above `floor_in_air` and half of it. Then false until restart().
    /// [haptic, nonblocking]
    [[nodiscard]] bool add(const EvaluatedLaw& law, const AppliedMotion& applied, bool is_driven) noexcept;
    /// Ends the second early, at the end of a run. Returns true as add() does.   [main]
    [[nodiscard]] bool finish() noexcept { return close_second(); }
    /// Forgets springs and sums; for another tool and other bodies. Totals stay.   [haptic, nonblocking]
    void restart() noexcept;

    /// A drive changes now.   [haptic, nonblocking]
    void change_drive() noexcept { to_settle_ = settling; }

    /// Returns the second in which the law made most, of all tools so far.
    [[nodiscard]] const MadeEnergy& largest() const noexcept { return largest_; }
    /// Returns the last second that ended.
    [[nodiscard]] const MadeEnergy& last() const noexcept { return last_; }
    /// Returns Σ λ T of the law's channels so far, over all tools [N·s].
    [[nodiscard]] double impulse() const noexcept { return impulse_; }
    /// Returns Σ λ |s| T so far, over all tools [J].
    [[nodiscard]] double work() const noexcept { return work_; }

    /// [J] in a second, bone newtons [assumed]. The shipped laws make up to 13 mJ, where a drill skids,
    /// and 9 mJ by their own wrench.
    static constexpr double floor = 40e-3, floor_in_air = 20e-3;
    static constexpr double settling = 1.0;  ///< [s]
    static constexpr double carried = 10.0;  ///< [–] force along a cut to force against it, at most [assumed]

private:
    [[nodiscard]] bool close_second() noexcept;

    double available_ = 0.0;             ///< [J] W
    double made_ = 0.0, through_ = 0.0;  ///< [J] in this second
    double shaken_ = 0.0, swung_ = 0.0;  ///< [J] of w beyond what bone carries: its sum, and without sign
    double elapsed_ = 0.0;               ///< [s]
    double to_settle_ = 0.0;             ///< [s] after a drive has changed
    bool is_reported_ = false;
    MadeEnergy largest_, last_;
    double impulse_ = 0.0, work_ = 0.0;
};

}  // namespace kerf
