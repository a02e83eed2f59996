// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// What must not happen between pose read and force out. A program that links this has these functions in the place of
/// the C library's: they are noted and passed on, for the whole program and whatever it loads.
namespace kerf::conformance {

enum class Forbidden : std::uint32_t {
    allocation,
    lock,
    exception,
    output,          ///< stdio
    clock,           ///< that of the machine: its answer differs from run to run
    random,          ///< likewise
    initialisation,  ///< of a function's static object at its first use: it may lock and allocate
    thread,
    count
};

/// The first call of each kind since `start`.
struct Watched {
    const char* function[static_cast<std::size_t>(Forbidden::count)]{};  ///< null: none was called
    [[nodiscard]] const char* of(Forbidden kind) const noexcept { return function[static_cast<std::size_t>(kind)]; }
};

/// How often this thread has called functions of each kind since it began.   [any] no allocation
using Counts = std::array<std::size_t, static_cast<std::size_t>(Forbidden::count)>;
[[nodiscard]] const Counts& counted_here() noexcept;

/// Whether calls are noted: not under a sanitizer, which has a heap and locks of its own.   [any]
[[nodiscard]] bool can_watch() noexcept;
/// Notes the calls of this thread from now on.   [any] no allocation
void start_watching() noexcept;
/// Returns what was called since then.   [any] no allocation
[[nodiscard]] Watched stop_watching() noexcept;

/// Whether the kernel reports system calls to their process (Linux 5.11, x86-64 and arm64).   [any]
[[nodiscard]] bool can_watch_system_calls() noexcept;
/// Reports the first system call of this thread from now on, in place of doing it.   [any]
void start_watching_system_calls() noexcept;
/// Returns the number of that system call; −1: there was none.   [any]
[[nodiscard]] long stop_watching_system_calls() noexcept;

}  // namespace kerf::conformance
