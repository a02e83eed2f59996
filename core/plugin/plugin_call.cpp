// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/plugin_call.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>

#include "core/plugin/plain_text.h"

namespace kerf {

namespace {

/// The call of one thread. Written by it alone; read by signal handlers and the watchdog.
struct alignas(64) ThreadCall {
    std::atomic<std::uint32_t> call{0};
    std::atomic<const kerf_component*> component{nullptr};
    std::atomic<std::uint64_t> count{0};

    [[nodiscard]] CallInProgress read() const noexcept {
        const auto now = static_cast<PluginCall>(call.load(std::memory_order_acquire));
        return {now, component.load(std::memory_order_relaxed), count.load(std::memory_order_relaxed)};
    }
};
std::array<ThreadCall, max_calling_threads> thread_calls;
std::atomic<std::size_t> calling_threads{0};
thread_local ThreadCall* own_call = nullptr;
thread_local bool is_calling = false;
std::atomic<ThrowHandler> throw_handler{nullptr};

class CallScope {
public:
    CallScope(PluginCall call, const kerf_component& component) noexcept {
        if (own_call == nullptr) own_call = &thread_calls[calling_threads.fetch_add(1) % max_calling_threads];
        own_call->component.store(&component, std::memory_order_relaxed);
        own_call->count.store(own_call->count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        own_call->call.store(static_cast<std::uint32_t>(call), std::memory_order_release);
        is_calling = true;
        std::atomic_signal_fence(std::memory_order_seq_cst);
    }
    ~CallScope() {
        std::atomic_signal_fence(std::memory_order_seq_cst);
        is_calling = false;
        own_call->call.store(0, std::memory_order_release);
    }
    CallScope(const CallScope&) = delete;
    CallScope& operator=(const CallScope&) = delete;
};

/// Ends the program while the call is still in progress, so that the handler can read it with `call_in_progress`.
[[noreturn]] void end_by_exception() noexcept {
    const ThrowHandler handler = throw_handler.load();
    if (handler == nullptr) std::terminate();
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::exception& e) {
        handler(e.what());
    } catch (...) {
        handler("");
    }
    handler("");
    std::terminate();
}

/// Runs a call into a plugin.
template <class Work>
auto run_call(PluginCall call, const kerf_component& component, const Work& work) noexcept {
    const CallScope note(call, component);
    try {
        return work();
    } catch (...) {
        end_by_exception();
    }
}

// A node of a list from which nothing is removed, so that a signal handler may walk the list at any time.
struct RegisteredPlugin {
    PluginName name;
    const kerf_entry* entry;
    const kerf_component* first;
    std::atomic<std::size_t> count;
    RegisteredPlugin* next;
};
std::atomic<RegisteredPlugin*> newest{nullptr};

}  // namespace

const char* to_text(PluginCall call) noexcept {
    switch (call) {
        case PluginCall::shape:
            return "shape";
        case PluginCall::begin:
            return "begin";
        case PluginCall::resist:
            return "resist";
        case PluginCall::commit:
            return "commit";
        case PluginCall::remesh:
            return "remesh";
        case PluginCall::find:
            return "find";
        case PluginCall::open:
            return "open";
        case PluginCall::read:
            return "read";
        case PluginCall::write:
            return "write";
        case PluginCall::close:
            return "close";
        default:
            return "";
    }
}

kerf_status call_shape(const kerf_component& tool, const double* parameters, kerf_tool_shape& out) noexcept {
    return run_call(PluginCall::shape, tool, [&] { return tool.tool->shape(parameters, &out); });
}

void call_begin(const kerf_component& law, const kerf_tick_in& in, void* state) noexcept {
    run_call(PluginCall::begin, law, [&] { law.force->begin(&in, state); });
}

kerf_status call_resist(const kerf_component& law, const kerf_tick_in& in, const void* state, kerf_law& out) noexcept {
    return run_call(PluginCall::resist, law, [&] { return law.force->resist(&in, state, &out); });
}

kerf_status call_commit(const kerf_component& law, const kerf_tick_in& in, const kerf_advance& advance, void* state,
                        kerf_commit_out& out) noexcept {
    return run_call(PluginCall::commit, law, [&] { return law.force->commit(&in, &advance, state, &out); });
}

kerf_status call_remesh(const kerf_component& strategy, const kerf_remesh_in& in, const kerf_arena& from,
                        kerf_arena& to, kerf_remesh_out& out, void* cache) noexcept {
    return run_call(PluginCall::remesh, strategy,
                    [&] { return strategy.remesher->remesh(&in, &from, &to, &out, cache); });
}

std::uint32_t call_find(const kerf_component& driver, const double* parameters, kerf_device_found* found,
                        std::uint32_t capacity) noexcept {
    return run_call(PluginCall::find, driver, [&] { return driver.device->find(parameters, found, capacity); });
}

kerf_status call_open(const kerf_component& driver, const kerf_device_open_in& in, std::int32_t (*is_cancelled)(void*),
                      void* context, kerf_device_open_out& out) noexcept {
    return run_call(PluginCall::open, driver, [&] { return driver.device->open(&in, is_cancelled, context, &out); });
}

void call_read(const kerf_component& driver, void* device, kerf_device_state& state) noexcept {
    run_call(PluginCall::read, driver, [&] { driver.device->read(device, &state); });
}

void call_write(const kerf_component& driver, void* device, const kerf_device_command& command) noexcept {
    run_call(PluginCall::write, driver, [&] { driver.device->write(device, &command); });
}

void call_close(const kerf_component& driver, void* device) noexcept {
    run_call(PluginCall::close, driver, [&] { driver.device->close(device); });
}

CallInProgress call_in_progress() noexcept {
    if (is_calling) return own_call->read();
    for (const ThreadCall& other : thread_calls)
        if (const CallInProgress now = other.read(); now.call != PluginCall::none) return now;
    return {};
}

CallInProgress call_in_progress_of(std::size_t thread) noexcept { return thread_calls[thread].read(); }

bool is_calling_plugin() noexcept { return is_calling; }

void set_throw_handler(ThrowHandler handler) noexcept { throw_handler.store(handler); }

void register_components(const kerf_entry& entry, const std::string& path) {
    auto registered = std::make_unique<RegisteredPlugin>();
    registered->name = {
        plain(entry.plugin_id), plain(std::filesystem::path(path).filename().string()), plain(path), {}};
    for (std::uint32_t i = 0; i < entry.component_count; ++i)
        registered->name.components.push_back(plain(entry.components[i].id));
    registered->entry = &entry;
    registered->first = entry.components;
    registered->count.store(entry.component_count);
    registered->next = newest.load();
    newest.store(registered.release());
}

void unregister_components(const kerf_entry* entry) noexcept {
    for (RegisteredPlugin* r = newest.load(); r != nullptr; r = r->next)
        if (r->entry == entry) r->count.store(0);
}

ComponentName name_of(const kerf_component* component) noexcept {
    const auto at = reinterpret_cast<std::uintptr_t>(component);
    for (const RegisteredPlugin* r = newest.load(); r != nullptr; r = r->next) {
        const auto first = reinterpret_cast<std::uintptr_t>(r->first);
        const std::size_t count = r->count.load();
        if (at >= first && at < first + count * sizeof(kerf_component))
            return {&r->name, r->name.components[(at - first) / sizeof(kerf_component)].c_str()};
    }
    return {};
}

}  // namespace kerf
