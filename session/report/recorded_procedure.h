// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Titles, goals and limits of a procedure for a run's page, from the recorded text.
namespace kerf::session {

/// A goal or limit as written in the text.
struct RecordedDemand {
    std::string quantity;                         ///< "depth", "clearance"; see Goal and Limit
    std::string of{};                             ///< zone of a clearance, id of a signal or measure; else empty
    std::optional<double> at_least{}, at_most{};  ///< SI
    std::string unit{};                           ///< of the bounds, as written
    std::optional<double> diameter{};             ///< [m] of a breach
    std::string reason{};                         ///< of a limit: the sentence for a trainee who breaks it

    /// Returns its name in results and events.
    [[nodiscard]] const std::string& name() const noexcept { return of.empty() ? quantity : of; }
};

struct RecordedStep {
    std::string id;
    std::string title{}, instrument{};              ///< the latter is an id
    std::vector<RecordedDemand> goals{}, limits{};  ///< in the order of the text
};

/// An instrument as written in the text.
struct RecordedInstrument {
    std::string id;
    std::optional<double> diameter{};  ///< [m] its parameter of that name
};

struct RecordedProcedure {
    std::string title;
    std::string variant_title, rehearsal_title;  ///< empty for none
    std::vector<RecordedStep> steps;
    std::vector<RecordedInstrument> instruments{};
};

/// Reads the data that the page needs from a procedure's text. It uses no plugin, so it also reads procedures whose
/// plugins are not installed. Leaves out unreadable parts.   [main]
/// @param rehearsal   id of the one that was run; may be empty
[[nodiscard]] RecordedProcedure recorded_procedure(const std::string& text, std::string_view rehearsal);

}  // namespace kerf::session
