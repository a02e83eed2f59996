// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace kerf {

/// How much of something long is done, 0 … 1, and what it is.
using Progress = std::function<void(double share, const std::string& what)>;

struct ImportOptions {
    bool with_shifts = false;  ///< also tell how sure a CT's border is: three times the work
    Progress progress = {};
};

/// How the border of a CT's bone moves with the threshold, where an axis enters it.
struct BorderShift {
    std::string axis;
    double step = 0.0;                   ///< [HU or grey] by which the threshold was moved both ways
    std::optional<double> lower, upper;  ///< [m] the entry moves along the axis, positive into the bone; none: no entry
};

/// What import did and decided, for people and for the record: no paths, no names, nothing of the files' headers that
/// could tell whose they are.
struct ImportReport {
    std::vector<std::string> notes;          ///< one sentence or two each
    std::vector<std::uint64_t> file_hashes;  ///< 64-bit FNV-1a of every data file's bytes, in the order they were read
    std::vector<BorderShift> shifts;         ///< one per axis, if asked for
};

/// Hash of a file's bytes; false if it cannot be read.   [main]
[[nodiscard]] bool hash_of_file(const std::string& file, std::uint64_t& hash);

/// One hash for several, in their order.
[[nodiscard]] std::uint64_t hash_of_hashes(const std::vector<std::uint64_t>& hashes);

/// A number with `digits` behind the point, whatever the locale.
[[nodiscard]] std::string rounded(double value, int digits);

}  // namespace kerf
