// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <optional>
#include <string>

/// Opens files for reading, only if they are regular files.
namespace kerf::text {

/// The reason why a file cannot be read, and advice: one sentence each.
struct FileFault {
    std::string problem, advice;
};

/// Returns a fault unless the name leads to a regular file. Does not open it: a FIFO would wait for a writer for ever,
/// and a device may deliver bytes without end. Never throws.   [main]
[[nodiscard]] std::optional<FileFault> fault_of_file(const std::string& file);

/// Returns the path of the file that a link leads to, over all further links; `file` itself if it is not a link, or
/// leads to no file. Never throws.   [main]
[[nodiscard]] std::string target_of_link(const std::string& file);

/// Opens a regular file to read its bytes. For any other file, returns a failed stream and opens nothing. Never throws.
/// [main]
[[nodiscard]] std::ifstream open_regular_file(const std::string& file);

}  // namespace kerf::text
