// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/loop/law_ledger.h"
#include "session/recording.h"

namespace kerf::run {

/// What a run found odd in its force laws. A verdict on such a run is invalid.
class LawChecks {
public:
    static constexpr const char* forceless = "bone.went_without_force";

    /// Compares the bone removed so far [m³] with what the laws resisted so far. Bone went without force if a tool has
    /// removed `interval` twice in succession and its law resisted neither. Returns the detail of the event `forceless`
    /// once this is more than `max_volume_at_once` and `max_fraction` of what the tool has removed; once a tool. A saw
    /// that begins a cut grazes bone, so less is judged when the tool has done its work.
    /// @param is_driven  a drive turns the tool: its motor does the work, so only the absence of any force is odd
    /// @param law        its name, with its plugin's
    [[nodiscard]] std::optional<std::string> follow(double removed, const LawLedger& ledger, bool is_driven,
                                                    const std::string& law);
    /// Returns the same detail if the tool, which now leaves, has taken more than `max_volume` and `max_fraction` of
    /// its bone without force.
    [[nodiscard]] std::optional<std::string> end_tool(double removed);
    /// Begins anew, after another tool was taken or bodies have changed.
    void restart(double removed, const LawLedger& ledger);
    /// Notes an event of the loop or of `follow`, if it is odd.
    void note(const std::string& id, const std::string& detail);

    /// Makes the verdict of a run with odd laws invalid, with the first reason of each sort. `has_reason`: the summary
    /// has that of an unsound law already.
    void judge(bool has_reason, session::RunSummary& summary) const;
    /// Returns the rows of the report, checks of the simulation.
    [[nodiscard]] std::vector<session::MetricRow> rows(const LawLedger& ledger) const;

private:
    struct Passed {
        double removed = 0.0;  ///< [m³]
        double impulse = 0.0;  ///< [N·s]
        double work = 0.0;     ///< [J]
    };
    // A running saw that is twisted in its kerf shaves 5 % off its walls.
    static constexpr double interval = 1e-9, max_volume = 5e-9, max_volume_at_once = 20e-9;  // [m³] [assumed]
    static constexpr double max_fraction = 0.6;                                              // [–] [assumed]
    [[nodiscard]] std::optional<std::string> judge_tool(double removed, double largest);

    Passed last_, before_;                             ///< the last comparison, and the one before
    double start_ = 0.0;                               ///< [m³] removed before the tool
    double of_tool_ = 0.0;                             ///< [m³] of bone that went without force by this tool
    double largest_ = 0.0;                             ///< the same, of the tool with most
    bool is_reported_ = false, was_reported_ = false;  ///< of this tool, of any
    std::size_t faults_ = 0, made_ = 0;
    std::string first_fault_, law_;
    std::vector<std::string> reasons_;  ///< the first of each other sort
};

}  // namespace kerf::run
