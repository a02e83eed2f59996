// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/plugin/process_notes.h"
#include "kerf/abi.h"
#include "kerf/device.h"
#include "kerf/remesh.h"

/// Functions for calls into plugins, so that a crash, an exit or a loop in a call can be attributed to its plugin.
/// After each call, rounding, traps and the other control words of the floating-point unit are as before it.
namespace kerf {

/// Calls a tool's `shape`.   [main]
[[nodiscard]] kerf_status call_shape(const kerf_component& tool, const double* parameters,
                                     kerf_tool_shape& out) noexcept;
/// Call a law's functions. They add only a few stores to memory: no lock, allocation or system call. An exception of
/// the plugin ends the program: see `set_throw_handler`.   [haptic, nonblocking]
void call_begin(const kerf_component& law, const kerf_tick_in& in, void* state) noexcept;
[[nodiscard]] kerf_status call_resist(const kerf_component& law, const kerf_tick_in& in, const void* state,
                                      kerf_law& out) noexcept;
[[nodiscard]] kerf_status call_commit(const kerf_component& law, const kerf_tick_in& in, const kerf_advance& advance,
                                      void* state, kerf_commit_out& out) noexcept;

/// Calls a strategy's `remesh`.   [worker]
[[nodiscard]] kerf_status call_remesh(const kerf_component& strategy, const kerf_remesh_in& in, const kerf_arena& from,
                                      kerf_arena& to, kerf_remesh_out& out, void* cache) noexcept;

/// Calls a driver's `find`. Pre: `found` has a capacity of `capacity` devices.   [main]
[[nodiscard]] std::uint32_t call_find(const kerf_component& driver, const double* parameters, kerf_device_found* found,
                                      std::uint32_t capacity) noexcept;
/// Calls a driver's `open`.   [main] may wait for the device
[[nodiscard]] kerf_status call_open(const kerf_component& driver, const kerf_device_open_in& in,
                                    std::int32_t (*is_cancelled)(void*), void* context,
                                    kerf_device_open_out& out) noexcept;
/// Call the functions of an open device.   [haptic, nonblocking]
void call_read(const kerf_component& driver, void* device, kerf_device_state& state) noexcept;
void call_write(const kerf_component& driver, void* device, const kerf_device_command& command) noexcept;
/// Calls a driver's `close`.   [main]
void call_close(const kerf_component& driver, void* device) noexcept;
/// Calls a driver's `problem`.   [main]
void call_problem(const kerf_component& driver, void* device, char text[240]) noexcept;

/// Returns whether a call into this component left other control words of the floating-point unit, and forgets all such
/// calls: of this thread, since it last called this function.   [any] nonblocking
[[nodiscard]] bool take_changed_floating_point(const kerf_component& component) noexcept;

/// Sets the handler of an exception that leaves a plugin's function. The handler gets the exception's text, empty if it
/// has none, and must not return. Null: std::terminate() is called.   [main]
using ThrowHandler = void (*)(const char* words);
void set_throw_handler(ThrowHandler handler) noexcept;

}  // namespace kerf
