// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "kerf/math.hpp"

namespace kerf::bone {

/// Callback with the finished fraction of a long task, 0 … 1, and its name.
using Progress = std::function<void(double share, const std::string& what)>;

struct ImportOptions {
    bool with_shifts = false;  ///< also computes the uncertainty of a CT's border; takes three times as long
    bool with_scan = false;    ///< also stores the values of the scan, for pictures
    Progress progress = {};
};

/// Shift of a CT bone's border with the threshold, at the point where an axis enters it.
struct BorderShift {
    std::string axis;
    double step = 0.0;                   ///< [HU or grey] change of the threshold in both directions
    const char* unit = "HU";             ///< or "grey levels"
    std::optional<double> lower, upper;  ///< [m] shift of the entry, positive into the bone; none: no entry
};

/// Findings and decisions of an import, for people and for the record. It has no paths, no names, and nothing of the
/// files' headers that identifies the patient.
struct ImportReport {
    std::vector<std::string> notes;                       ///< one sentence or two each
    std::vector<documents::LandmarkPoint> fitted_points;  ///< with their fitted positions
    std::vector<documents::LandmarkAxis> fitted_axes;
    std::vector<std::uint64_t> file_hashes;  ///< 64-bit FNV-1a of every data file's bytes, in the order they were read
    std::vector<BorderShift> shifts;         ///< one for each axis, on request
    std::function<double(Vec3 lps)> scan_value;  ///< [HU or grey] of a CT, on request; NaN where it was not sampled
};

/// Computes the hash of a file's bytes. Returns false if the file cannot be read.   [main]
[[nodiscard]] bool hash_of_file(const std::string& file, std::uint64_t& hash);

/// Returns one hash of several, in their order.
[[nodiscard]] std::uint64_t hash_of_hashes(const std::vector<std::uint64_t>& hashes);

/// Returns a number as text with `digits` decimals, in any locale.
[[nodiscard]] std::string rounded(double value, int digits);

}  // namespace kerf::bone
