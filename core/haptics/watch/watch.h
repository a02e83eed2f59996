// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Detects calls that are forbidden between pose read and force out. A program that links this library uses these
/// functions instead of the C library's. Each call is noted and passed on, also for all libraries that the program
/// loads.
namespace kerf::conformance {

enum class Forbidden : std::uint32_t {
    allocation,
    lock,
    exception,
    output,          ///< stdio
    clock,           ///< the machine's clock: its value differs from run to run
    random,          ///< its values differ from run to run
    initialisation,  ///< of a function-local static object at its first use: it may lock and allocate
    thread,
    count
};

/// The first call of each kind since `start`.
struct Watched {
    const char* function[static_cast<std::size_t>(Forbidden::count)]{};  ///< null: no call
    [[nodiscard]] const char* of(Forbidden kind) const noexcept { return function[static_cast<std::size_t>(kind)]; }
};

/// Counts of forbidden calls by kind.
using Counts = std::array<std::size_t, static_cast<std::size_t>(Forbidden::count)>;
/// Returns this thread's counts since its start.   [any] no allocation
[[nodiscard]] const Counts& counted_here() noexcept;

/// Returns whether calls are noted. They are not under a sanitizer, which has its own heap and locks.   [any]
[[nodiscard]] bool can_watch() noexcept;
/// Starts to note the calls of this thread.   [any] no allocation
void start_watching() noexcept;
/// Stops, and returns the noted calls.   [any] no allocation
[[nodiscard]] Watched stop_watching() noexcept;

/// Returns whether the kernel reports system calls to their process (Linux 5.11, x86-64 and arm64).   [any]
[[nodiscard]] bool can_watch_system_calls() noexcept;
/// Starts to catch system calls of this thread. The first one is reported and not executed.   [any]
void start_watching_system_calls() noexcept;
/// Stops, and returns the number of the caught system call; −1: none.   [any]
[[nodiscard]] long stop_watching_system_calls() noexcept;

}  // namespace kerf::conformance
