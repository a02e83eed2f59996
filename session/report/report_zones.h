// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "session/recording.h"

/// Zones in the picture of the bone, and where the tool came closest to them.
namespace kerf::session {

/// Returns #rrggbb for a zone; large indices wrap around.   [any]
[[nodiscard]] std::string_view zone_colour(std::size_t zone) noexcept;

/// Returns "2.68 mm inside canal" or "1.4 mm from canal".   [any]
[[nodiscard]] std::string approach_text(const ApproachRow& row);

/// Returns the approaches that the page marks: of each zone the closest one, and each one into it.   [any]
[[nodiscard]] std::vector<ApproachRow> marked_approaches(const RunSummary& summary);

/// Returns whether an approach is into a zone, or breaks a limit on the distance to it.   [any]
[[nodiscard]] bool is_bad(const ApproachRow& row, const RunSummary& summary);

/// Returns the legend of the zones' colours as HTML; empty without zones.   [any]
[[nodiscard]] std::string zone_legend_html(const RunSummary& summary);

/// Returns the list of marked approaches as HTML; empty without any.   [any]
[[nodiscard]] std::string approaches_html(const RunSummary& summary);

}  // namespace kerf::session
