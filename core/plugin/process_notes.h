// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "kerf/abi.h"

/// Notes of a process about its plugins: which call is in progress, how the plugins are named, how the process ends. A
/// signal handler can read them; so can the parent of the process, after its end too.
namespace kerf {

enum class PluginCall : std::uint32_t {
    none,
    shape,
    begin,
    resist,
    commit,
    remesh,
    find,
    open,
    read,
    write,
    close,
    problem
};
[[nodiscard]] const char* to_text(PluginCall call) noexcept;  // [any]

/// From now on, processes that this one forks write their notes into memory that both can read. Returns false if there
/// is no memory.   [main, before any plugin is loaded]
[[nodiscard]] bool begin_common_notes() noexcept;

// ---- calls ---------------------------------------------------------------------------------------------------------

/// The call of one thread. It alone writes it.
struct alignas(64) ThreadCall {
    std::atomic<std::uint32_t> call{0}, last{0};
    std::atomic<const kerf_component*> component{nullptr};
    std::atomic<std::uint64_t> count{0};
};

/// Notes a call while it lives.   [any, nonblocking]
class CallNote {
public:
    CallNote(PluginCall call, const kerf_component& component) noexcept;
    ~CallNote();
    CallNote(const CallNote&) = delete;
    CallNote& operator=(const CallNote&) = delete;
};

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
/// Returns the last call of the thread with the greatest number of calls, which may be over, or `none`.   [any]
/// async-signal-safe
[[nodiscard]] CallInProgress last_call() noexcept;
/// Returns whether the calling thread is the one inside the plugin.   [any] async-signal-safe
[[nodiscard]] bool is_calling_plugin() noexcept;

// ---- names ---------------------------------------------------------------------------------------------------------

void register_components(const kerf_entry& entry, const std::string& path);  // [main]
void unregister_components(const kerf_entry* entry) noexcept;                // [main] before it is unloaded

/// The names of a plugin and of one of its components, for messages. They stay valid after the plugin is unloaded.
/// Empty if no loaded plugin has the component.
struct ComponentName {
    const char *plugin = "", *file = "", *path = "", *component = "";
    [[nodiscard]] bool is_known() const noexcept { return *path != '\0'; }
};
[[nodiscard]] ComponentName name_of(const kerf_component* component) noexcept;  // [any] async-signal-safe

// ---- the end of the process ----------------------------------------------------------------------------------------

/// Notes the file that a run records, for its end.   [main]
void note_record(const std::string& path) noexcept;
[[nodiscard]] const char* noted_record() noexcept;  // [any] async-signal-safe

/// Notes the exit code that this process is about to end with. A process that ends otherwise was ended by a plugin, by
/// a signal or by a fault. Only the process that begin_common_notes() allowed may note one: see allow_last_word().
/// [any] async-signal-safe
void say_last_word(int exit_code) noexcept;
/// Only the process with this id may say the last word; copies that a plugin makes of it may not.   [main]
void allow_last_word(int process) noexcept;
[[nodiscard]] std::optional<int> last_word() noexcept;  // [any]

}  // namespace kerf
