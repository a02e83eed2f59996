// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <optional>
#include <string>

/// How every reader of a file gets at its bytes.
namespace kerf {

/// Why a file cannot be read, and what to do about it: a sentence each.
struct FileFault {
    std::string problem, advice;
};

/// Checks that a name leads to a regular file, without opening it: a FIFO waits for a writer for ever, a device may
/// give bytes without end. Returns nothing if it does. Never throws.   [main]
[[nodiscard]] std::optional<FileFault> fault_of_file(const std::string& file);

/// Opens a regular file to read its bytes; of anything else the stream has failed, and nothing is opened. Never throws.
/// [main]
[[nodiscard]] std::ifstream open_regular_file(const std::string& file);

}  // namespace kerf
