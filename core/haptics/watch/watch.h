// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Detects calls that are forbidden in a tick. A program that links this library, and all libraries that it loads, call
/// the functions of watch.cpp instead of the C library's. Each of these counts the call and calls the C library.
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

/// The first call of each kind since `start_watching`.
struct Watched {
    const char* function[static_cast<std::size_t>(Forbidden::count)]{};  ///< null: no call
    [[nodiscard]] const char* of(Forbidden kind) const noexcept { return function[static_cast<std::size_t>(kind)]; }
};

/// Number of forbidden calls of each kind, at the index `Forbidden`.
using Counts = std::array<std::size_t, static_cast<std::size_t>(Forbidden::count)>;
/// Returns the counts of the calling thread since it started, watched or not.   [any] no allocation
[[nodiscard]] const Counts& counted_here() noexcept;

/// Returns whether forbidden calls are detected. Under a sanitizer, which has its own heap and locks, they are not.
/// [any]
[[nodiscard]] bool can_watch() noexcept;
/// From now on, notes the first call of each kind that the calling thread makes.   [any] no allocation
void start_watching() noexcept;
/// Stops watching. Returns the noted calls.   [any] no allocation
[[nodiscard]] Watched stop_watching() noexcept;

/// Returns whether the kernel can report a system call to its process instead of executing it (Linux 5.11 or later).
/// [any]
[[nodiscard]] bool can_watch_system_calls() noexcept;
/// From now on, catches the first system call of the calling thread: it is noted and not executed. Later ones are
/// executed and not noted.   [any]
void start_watching_system_calls() noexcept;
/// Stops watching. Returns the number of the system call that was caught, or −1 for none.   [any]
[[nodiscard]] long stop_watching_system_calls() noexcept;

}  // namespace kerf::conformance
