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

/// How numbers get into report.html.
namespace kerf {

/// RFC 4648, with padding.   [any]
[[nodiscard]] std::string base64(std::span<const unsigned char> bytes);

/// Text for an element or a quoted attribute of HTML. Hidden characters are escaped
/// (text/printable.h).   [any]
[[nodiscard]] std::string html_escaped(std::string_view text);

/// As many digits as mean something: one or two of the uncertainty where it is known (> 0), else three of the value.
/// "−" for minus, "–" for what is not finite. There are more digits where the value would have the text of one of its
/// `bounds` without being equal to it.   [any]
[[nodiscard]] std::string sensible_number(double value, double uncertainty = -1.0, std::span<const double> bounds = {});

/// Returns a number as a document has it, at most ten digits, with the same signs.   [any]
[[nodiscard]] std::string number_as_written(double value);

/// A unit as people write it: mm³ for mm3, N·m for N*m. Others as they are.   [any]
[[nodiscard]] std::string unit_for_people(const std::string& unit);

/// A round number for the step of an axis: about a fifth of `range`.   [any]
[[nodiscard]] double round_step(double range);

/// #rrggbb for a tissue by its index; −1 and beyond wrap around.   [any]
[[nodiscard]] std::string_view tissue_colour(std::size_t tissue) noexcept;

/// What the page's script reads, as JSON that is safe inside <script>.   [any]
[[nodiscard]] std::string report_data_json(const RunSummary& summary, const DrawnRun& run);

/// Thrust over depth as a picture that needs no script.   [any]
[[nodiscard]] std::string thrust_over_depth_svg(const std::vector<TickRow>& drawn);

}  // namespace kerf
