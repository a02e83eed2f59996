// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "session/recording.h"
#include "session/report/drawn_run.h"
#include "session/report/recorded_procedure.h"

/// Formats numbers and text for report.html.
namespace kerf::session {

/// Returns base64 of RFC 4648, with padding.   [any]
[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);

/// Returns text for an element or a quoted attribute of HTML. Hidden characters are escaped (text/printable.h).   [any]
[[nodiscard]] std::string html_escaped(std::string_view text);

/// Returns a value with its significant digits: one or two of the uncertainty if it is known (> 0), else three of the
/// value. Uses "−" for minus, and "–" for values that are not finite. Adds digits if the text would equal the text of a
/// bound although the value differs.   [any]
[[nodiscard]] std::string sensible_number(double value, double uncertainty = -1.0, std::span<const double> bounds = {});

/// Returns a number as written in documents, with at most ten digits and the same minus sign.   [any]
[[nodiscard]] std::string number_as_written(double value);

/// Returns a unit for people: mm³ for mm3, N·m for N*m. Other units stay unchanged.   [any]
[[nodiscard]] std::string unit_for_people(const std::string& unit);

/// Returns a round step for an axis: about a fifth of `range`.   [any]
[[nodiscard]] double round_step(double range);

/// Returns #rrggbb for a tissue.   Pre: it is one of the names.   [any]
[[nodiscard]] std::string colour_of_tissue(const std::vector<std::string>& names, std::size_t tissue);

/// Returns the data for the page's script, as JSON that is safe inside <script>.   [any]
/// @param procedure   bounds of the plots; without it they have none
[[nodiscard]] std::string report_data_json(const RunSummary& summary, const DrawnRun& run,
                                           const RecordedProcedure& procedure = {});

}  // namespace kerf::session
