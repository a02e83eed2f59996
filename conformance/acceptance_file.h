// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "kerf/math.hpp"

/// Acceptance files: a scripted motion of a tool in a block of bone, and the forces that its law made when the file was
/// recorded. docs/guide/conformance.md describes the format.
namespace kerf::conformance {

struct AcceptanceRow {
    std::uint64_t tick = 0;
    Pose block_from_tool = identity_pose();
    double drive = 1.0;                             ///< [–] of the drives' defaults
    std::optional<std::array<double, 6>> wrench{};  ///< of the bone on the tool, block frame [N, N·m]
};

struct AcceptanceFile {
    std::string subject;              ///< "burr with burring"; empty: the plugin's first law
    double tolerance = 0.02;          ///< [–] of the force of a row
    double floor = 0.05;              ///< [N] that is allowed besides
    std::vector<AcceptanceRow> rows;  ///< at least two; between them the motion is straight
};

/// Reads a file's text; `name` is for messages. Error: what is wrong, with file and line.   [any]
[[nodiscard]] std::optional<AcceptanceFile> parse_acceptance(std::istream& in, const std::string& name,
                                                             std::string& error);
/// Reads a file.   [main]
[[nodiscard]] std::optional<AcceptanceFile> read_acceptance(const std::string& path, std::string& error);
/// As text. The same everywhere.   [any]
[[nodiscard]] std::string acceptance_text(const AcceptanceFile& file);

/// A motion that shows most of what a tool does: into bone, sideways, out, in askew, switched off. Its numbers are
/// those of its text, so that what was recorded with it is what the file gives.   [any]
[[nodiscard]] AcceptanceFile standard_script();

/// What differs between what was recorded and what is found, row by row; both have a wrench in each row.
struct Comparison {
    std::size_t worst_row = 0;
    std::size_t worst_component = 0;  ///< 0 … 5
    double worst = 0.0;               ///< [–] of what is allowed; more than 1: not accepted
    double allowed = 0.0;             ///< [N] or [N·m], there
};
[[nodiscard]] Comparison compare(const AcceptanceFile& recorded, const std::vector<AcceptanceRow>& found);

/// The differences as CSV.   [any]
[[nodiscard]] std::string difference_csv(const AcceptanceFile& recorded, const std::vector<AcceptanceRow>& found);

}  // namespace kerf::conformance
