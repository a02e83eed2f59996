// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/plugin/file_stamp.h"

namespace kerf::text {

/// The SHA-256 of a file, and its stamp while it was read.
struct FileDigest {
    std::string digest;  ///< 64 hexadecimal digits; empty: the file could not be read
    FileStamp stamp{};
    std::string error{};  ///< for people; empty if there is a digest
};

/// Reads a regular file once, and again if it changed meanwhile. Memory does not grow with the file.   [main]
[[nodiscard]] FileDigest digest_of_file(const std::string& path);

}  // namespace kerf::text
