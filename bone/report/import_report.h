// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "kerf/math.hpp"

namespace kerf {

/// How much of something long is done, 0 … 1, and what it is.
using Progress = std::function<void(double share, const std::string& what)>;

struct ImportOptions {
    bool with_shifts = false;  ///< also tell how sure a CT's border is: three times the work
    bool with_scan = false;    ///< also keep the values that bone was made of, for pictures
    Progress progress = {};
};

/// How the border of a CT's bone moves with the threshold, where an axis enters it.
struct BorderShift {
    std::string axis;
    double step = 0.0;                   ///< [HU or grey] by which the threshold was moved both ways
    const char* unit = "HU";             ///< or "grey levels"
    std::optional<double> lower, upper;  ///< [m] the entry moves along the axis, positive into the bone; none: no entry
};

/// What import did and decided, for people and for the record: no paths, no names, nothing of the files' headers that
/// could tell whose they are.
struct ImportReport {
    std::vector<std::string> notes;            ///< one sentence or two each
    std::vector<LandmarkPoint> fitted_points;  ///< as they were found
    std::vector<LandmarkAxis> fitted_axes;
    std::vector<std::uint64_t> file_hashes;  ///< 64-bit FNV-1a of every data file's bytes, in the order they were read
    std::vector<BorderShift> shifts;         ///< one per axis, if asked for
    std::function<double(Vec3 lps)> scan_value;  ///< [HU or grey] of a CT, if asked for; NaN where it was not looked at
};

/// Hash of a file's bytes; false if it cannot be read.   [main]
[[nodiscard]] bool hash_of_file(const std::string& file, std::uint64_t& hash);

/// One hash for several, in their order.
[[nodiscard]] std::uint64_t hash_of_hashes(const std::vector<std::uint64_t>& hashes);

/// A number with `digits` behind the point, whatever the locale.
[[nodiscard]] std::string rounded(double value, int digits);

}  // namespace kerf
