// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>

/// The streams to which the program itself prints. A plugin that prints does so to descriptors 1 and 2, which are the
/// same until separate_streams() is called.
namespace kerf {

[[nodiscard]] std::FILE* own_output() noexcept;  // [any]
[[nodiscard]] std::FILE* own_errors() noexcept;  // [any]
[[nodiscard]] int own_error_file() noexcept;     // [any] async-signal-safe: the descriptor of own_errors()

/// From now on, descriptors 1 and 2 lead to `file`, and the program's own streams to where those led before. Returns
/// false if the system has no descriptors left; nothing is changed then.   [main, while the process has one thread]
[[nodiscard]] bool separate_streams(int file) noexcept;
/// In a process that was forked: the program's own streams are stdout and stderr again.   [main]
void unite_streams() noexcept;

}  // namespace kerf
