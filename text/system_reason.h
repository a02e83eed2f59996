// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::text {

/// Returns the reason of a failed system call for people, with advice for a full disk, a limit of file size and a lack
/// of memory. No full stop at its end.   [any]
/// @param error  errno
[[nodiscard]] std::string system_reason(int error);

/// Returns the command that raises the limit of memory of this process: "ulimit -d" if only that is set, otherwise
/// "ulimit -v". Without the heap.   [any]
[[nodiscard]] const char* memory_limit_command() noexcept;

/// Returns a problem with the advice to raise the limit of memory, if this process has one; else the problem alone. For
/// a library that fails without a reason.   [any]
[[nodiscard]] std::string with_memory_limit(std::string problem);

/// Returns advice for a system that gives no thread: which limit to raise. Without the heap: there may be no memory
/// left.   [any]
[[nodiscard]] const char* thread_advice() noexcept;

}  // namespace kerf::text
