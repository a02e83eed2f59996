// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kerf/abi.h"
#include "kerf/remesh.h"

/// Functions for all calls into plugins, so that a crash, an exit or a loop in a call can be attributed to its plugin.
namespace kerf {

enum class PluginCall : std::uint32_t { none, shape, begin, resist, commit, remesh };
[[nodiscard]] const char* to_text(PluginCall call) noexcept;  // [any]

/// Calls a tool's `shape`.   [main]
[[nodiscard]] kerf_status call_shape(const kerf_component& tool, const double* parameters,
                                     kerf_tool_shape& out) noexcept;
/// Calls a law's functions. The overhead is plain stores: no lock, allocation or system call. A plugin that throws ends
/// the program: see `set_throw_handler`.   [haptic, nonblocking]
void call_begin(const kerf_component& law, const kerf_tick_in& in, void* state) noexcept;
[[nodiscard]] kerf_status call_resist(const kerf_component& law, const kerf_tick_in& in, const void* state,
                                      kerf_law& out) noexcept;
[[nodiscard]] kerf_status call_commit(const kerf_component& law, const kerf_tick_in& in, const kerf_advance& advance,
                                      void* state, kerf_commit_out& out) noexcept;

/// Calls a strategy's `remesh`.   [worker]
[[nodiscard]] kerf_status call_remesh(const kerf_component& strategy, const kerf_remesh_in& in, const kerf_arena& from,
                                      kerf_arena& to, kerf_remesh_out& out, void* cache) noexcept;

/// The call in progress. Kerf calls plugins on one thread at a time.
struct CallInProgress {
    PluginCall call = PluginCall::none;
    const kerf_component* component = nullptr;
    std::uint64_t count = 0;  ///< number of all calls so far; equal numbers are the same call
};
[[nodiscard]] CallInProgress call_in_progress() noexcept;  // [any] async-signal-safe
/// Returns whether this thread makes the call.   [any] async-signal-safe
[[nodiscard]] bool is_calling_plugin() noexcept;

/// Sets the handler of an exception that leaves a plugin. It gets the exception's text and must not return. Null:
/// std::terminate().   [main]
using ThrowHandler = void (*)(const char* words);
void set_throw_handler(ThrowHandler handler) noexcept;

/// The name of a loaded plugin in messages. It outlives the plugin, and has no pointer into the plugin's memory.
struct PluginName {
    std::string id, file, path;
    std::vector<std::string> components;
};
void register_components(const kerf_entry& entry, const std::string& path);  // [main]
void unregister_components(const kerf_entry* entry) noexcept;                // [main] before it is unloaded

/// The plugin and the id of a component; null for a component of no loaded plugin.
struct ComponentName {
    const PluginName* plugin = nullptr;
    const char* component = "";
};
[[nodiscard]] ComponentName name_of(const kerf_component* component) noexcept;  // [any] async-signal-safe

}  // namespace kerf
