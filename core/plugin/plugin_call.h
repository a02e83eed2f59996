// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kerf/abi.h"
#include "kerf/device.h"
#include "kerf/remesh.h"

/// Functions for calls into plugins, so that a crash, an exit or a loop in a call can be attributed to its plugin.
namespace kerf {

enum class PluginCall : std::uint32_t { none, shape, begin, resist, commit, remesh, find, open, read, write, close };
[[nodiscard]] const char* to_text(PluginCall call) noexcept;  // [any]

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

/// A call in progress. A run on the clock calls laws on two threads, each with states of its own.
struct CallInProgress {
    PluginCall call = PluginCall::none;
    const kerf_component* component = nullptr;
    std::uint64_t count = 0;  ///< number of calls of its thread so far, this one included: it identifies the call
};
/// Number of threads whose calls are kept apart. More than these take the index of an earlier one.
inline constexpr std::size_t max_calling_threads = 16;
/// Returns the call of this thread, else one of another thread, or `none`.   [any] async-signal-safe
[[nodiscard]] CallInProgress call_in_progress() noexcept;
/// Returns the call of one of the threads, 0 … `max_calling_threads` − 1, or `none`.   [any]
[[nodiscard]] CallInProgress call_in_progress_of(std::size_t thread) noexcept;
/// Returns whether the calling thread is the one inside the plugin.   [any] async-signal-safe
[[nodiscard]] bool is_calling_plugin() noexcept;

/// Sets the handler of an exception that leaves a plugin's function. The handler gets the exception's text, empty if it
/// has none, and must not return. Null: std::terminate() is called.   [main]
using ThrowHandler = void (*)(const char* words);
void set_throw_handler(ThrowHandler handler) noexcept;

/// The names of a loaded plugin and of its components, for messages. They stay valid after the plugin is unloaded.
struct PluginName {
    std::string id, file, path;
    std::vector<std::string> components;
};
void register_components(const kerf_entry& entry, const std::string& path);  // [main]
void unregister_components(const kerf_entry* entry) noexcept;                // [main] before it is unloaded

/// The plugin and the id of a component. `plugin` is null if no loaded plugin has the component.
struct ComponentName {
    const PluginName* plugin = nullptr;
    const char* component = "";
};
[[nodiscard]] ComponentName name_of(const kerf_component* component) noexcept;  // [any] async-signal-safe

}  // namespace kerf
