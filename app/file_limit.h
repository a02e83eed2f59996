// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "text/source.h"

/// The number of files that the system lets a process open.
namespace kerf::app {

inline constexpr std::size_t min_open_files = 32;  ///< a run opens about half of them at once

/// Raises the limit of open files as far as the user may, and returns an error (E0720) if fewer than `min_open_files`
/// more can be opened. Without this check a plugin would seem to be damaged, and a strategy to be missing.   [main]
[[nodiscard]] text::Diagnostics check_file_limit();

/// Returns that error for a process that can open `free` more files, with this limit.   [any]
[[nodiscard]] text::Diagnostics refusal_of_file_limit(std::size_t free, unsigned long limit);

}  // namespace kerf::app
