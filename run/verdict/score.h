// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/procedure.h"
#include "run/verdict/step_monitor.h"
#include "session/recording.h"

/// The score of a run: the outcome sets a band, and what the hand earned of the plan sets the score within it.
namespace kerf::run {

/// The version of the rules in this file. Sessions state it.
inline constexpr int score_rules = 2;

/// A class of outcomes.
struct ScoreBand {
    const char* id;
    double lowest, highest;  ///< scores
};

/// Returns the band of an outcome. The worst that applies counts: a critical limit broken, a goal missed, a serious
/// limit broken, a minor one. Otherwise the run has passed.   [any] pure
/// @param is_missing   a limit could not be measured, or a planned implant is not there
[[nodiscard]] const ScoreBand& band_of(const StepMonitor& monitor, session::Verdict verdict, bool is_missing) noexcept;

/// Returns how much of its goals a step has reached, 0 … 1: the least over its goals, as they are at its end. A goal
/// that counts up earns in proportion. A step that never began earns nothing.   [any] pure
[[nodiscard]] double reached_part(const StepState& state) noexcept;

/// Computes band, score and deductions. Pre: verdict and metrics of `summary` are set.   [any] pure
///
///     score = lowest + (highest − lowest) Q,   Q = Σ w e / Σ w;   0 if no step began
///
/// With `scoring:` each of its metrics is a part with its weight w, and earns e = g q: the goals g that its step has
/// reached, times q = (none − x)/(none − full), limited to 0 … 1. A step without a metric is a part with w = 1 and
/// e = g. Without `scoring:`, each step is a part, and so is each limit, with e = g of its step, or 0 if it was
/// broken or could not be measured.
void score(const StepMonitor& monitor, const documents::Procedure& procedure, session::RunSummary& summary);

}  // namespace kerf::run
