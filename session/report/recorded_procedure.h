// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What a run's page shows of the procedure: titles, goals and limits, as the recorded text has them.
namespace kerf {

/// A goal or limit as it is written.
struct RecordedDemand {
    std::string quantity;                         ///< "depth", "clearance"; see Goal and Limit
    std::string of{};                             ///< zone of a clearance, id of a signal or measure; else empty
    std::optional<double> at_least{}, at_most{};  ///< SI
    std::string unit{};                           ///< of the bounds, as it is written
    std::optional<double> diameter{};             ///< [m] of a breach
    std::string reason{};                         ///< of a limit: the sentence for a trainee who breaks it

    /// How results and events call it.
    [[nodiscard]] const std::string& name() const noexcept { return of.empty() ? quantity : of; }
};

struct RecordedStep {
    std::string id;
    std::vector<RecordedDemand> goals, limits;  ///< in the order of the text
};

struct RecordedProcedure {
    std::string title;
    std::string variant_title, rehearsal_title;  ///< empty for none
    std::vector<RecordedStep> steps;
};

/// Reads what the page needs of a procedure's text. No plugin is asked, so it also reads procedures whose plugins are
/// not here. What cannot be read is left out.   [main]
/// @param rehearsal   id of the one that was run; may be empty
[[nodiscard]] RecordedProcedure recorded_procedure(const std::string& text, std::string_view rehearsal);

}  // namespace kerf
