// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace kerf {

/// Identifies the contents of a file without reading them: two stamps differ if the file was replaced or written
/// between them. All zero: there was no file.
struct FileStamp {
    std::uint64_t device = 0, number = 0, size = 0;
    std::int64_t modified = 0, changed = 0;  ///< [ns]
    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Returns the stamp of the file that a name leads to, or that is open.   [any]
[[nodiscard]] FileStamp stamp_of(const std::string& path) noexcept;
[[nodiscard]] FileStamp stamp_of(int open_file) noexcept;

}  // namespace kerf
