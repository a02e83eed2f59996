// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kerf/abi.h"
#include "kerf/remesh.h"

/// Every call into a plugin goes through here, so that a crash, an exit or a loop in it can be named.
namespace kerf {

enum class PluginCall : std::uint32_t { none, shape, begin, resist, commit, remesh };
[[nodiscard]] const char* to_text(PluginCall call) noexcept;  // [any]

/// Calls a tool's `shape`.   [main]
[[nodiscard]] kerf_status call_shape(const kerf_component& tool, const double* parameters,
                                     kerf_tool_shape& out) noexcept;
/// Call a law's functions. What they add are plain stores: no lock, allocation or system call. A plugin that throws
/// ends the program: see `set_throw_handler`.   [haptic, nonblocking]
void call_begin(const kerf_component& law, const kerf_tick_in& in, void* state) noexcept;
[[nodiscard]] kerf_status call_resist(const kerf_component& law, const kerf_tick_in& in, const void* state,
                                      kerf_law& out) noexcept;
[[nodiscard]] kerf_status call_commit(const kerf_component& law, const kerf_tick_in& in, const kerf_advance& advance,
                                      void* state, kerf_commit_out& out) noexcept;

/// Calls a strategy's `remesh`.   [worker]
[[nodiscard]] kerf_status call_remesh(const kerf_component& strategy, const kerf_remesh_in& in, const kerf_arena& from,
                                      kerf_arena& to, kerf_remesh_out& out, void* cache) noexcept;

/// The call that is going on. Kerf calls plugins on one thread at a time.
struct CallInProgress {
    PluginCall call = PluginCall::none;
    const kerf_component* component = nullptr;
    std::uint64_t count = 0;  ///< of all calls so far; the same number is the same call
};
[[nodiscard]] CallInProgress call_in_progress() noexcept;  // [any] async-signal-safe
/// Whether it is this thread that calls.   [any] async-signal-safe
[[nodiscard]] bool is_calling_plugin() noexcept;

/// Called with the words of an exception that left a plugin; must not return. Null: std::terminate().   [main]
using ThrowHandler = void (*)(const char* words);
void set_throw_handler(ThrowHandler handler) noexcept;

/// A loaded plugin as messages name it. It outlives the plugin, and holds nothing of the plugin's memory.
struct PluginName {
    std::string id, file, path;
    std::vector<std::string> components;
};
void remember_components(const kerf_entry& entry, const std::string& path);  // [main]
void forget_components(const kerf_entry* entry) noexcept;                    // [main] before it is unloaded

/// Whose component it is, and the component's id; null where it is none of a loaded plugin's.
struct ComponentName {
    const PluginName* plugin = nullptr;
    const char* component = "";
};
[[nodiscard]] ComponentName name_of(const kerf_component* component) noexcept;  // [any] async-signal-safe

}  // namespace kerf
