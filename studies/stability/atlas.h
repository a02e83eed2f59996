// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "studies/stability/finding.h"

/// Findings as files and lines for people. For training and research; not for diagnosis, planning or deciding
/// treatment.
namespace kerf::stability {

/// One finding as a line of the printed table, and the line above the first.
[[nodiscard]] std::string table_head();
[[nodiscard]] std::string table_line(const Finding& finding);

/// How many pass, fail and are not applicable, by method.
[[nodiscard]] std::string tally(std::span<const Finding> findings);

/// A row per finding. The first line, a comment, says what it is not for.
[[nodiscard]] std::string atlas_csv(std::span<const Finding> findings);

/// A grid: a row per test, scene and method, a column per device, hand and delay. Filled: passes; hollow: fails; a
/// dash: not applicable; empty: not looked at. Where several findings share a cell the worst is shown, and all are told
/// when the pointer rests on it.
[[nodiscard]] std::string atlas_svg(std::span<const Finding> findings);

/// Writes stability.csv and stability.svg, each whole or not at all. Returns what went wrong, for people; empty if
/// nothing did.   [main]
[[nodiscard]] std::string write_atlas(const std::string& folder, std::span<const Finding> findings);

}  // namespace kerf::stability
