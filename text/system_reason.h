// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::text {

/// Returns the reason of a failed system call for people, with advice for a full disk, a limit of file size and a lack
/// of memory. No full stop at its end.   [any]
/// @param error  errno
[[nodiscard]] std::string system_reason(int error);

/// Returns advice for a system that gives no thread: which limit to raise. Without the heap: there may be no memory
/// left.   [any]
[[nodiscard]] const char* thread_advice() noexcept;

}  // namespace kerf::text
