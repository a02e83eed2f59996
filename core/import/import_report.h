// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kerf {

/// What import did and decided, for people and for the record: no paths, no names, nothing of the files' headers that
/// could tell whose they are.
struct ImportReport {
    std::vector<std::string> notes;          ///< one sentence or two each
    std::vector<std::uint64_t> file_hashes;  ///< 64-bit FNV-1a of every data file's bytes, in the order they were read
};

/// Hash of a file's bytes; false if it cannot be read.   [main]
[[nodiscard]] bool hash_of_file(const std::string& file, std::uint64_t& hash);

/// One hash for several, in their order.
[[nodiscard]] std::uint64_t hash_of_hashes(const std::vector<std::uint64_t>& hashes);

/// A number with `digits` behind the point, whatever the locale.
[[nodiscard]] std::string rounded(double value, int digits);

}  // namespace kerf
