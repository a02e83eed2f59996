// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

/// The parent of the worker (app/worker.h), as the worker sees it.
namespace kerf::app {

enum class ParentState { unknown, running, stopped, ended };

/// Records that this process is the worker of a parent.   [main] before `parent_state`
void note_parent(pid_t parent) noexcept;
/// Returns the state of that parent; unknown in a process that is no worker. Allocates nothing.   [any]
[[nodiscard]] ParentState parent_state() noexcept;
/// Lets a stopped parent continue.   [any]
void continue_parent() noexcept;

}  // namespace kerf::app
