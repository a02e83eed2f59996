// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/plugin_call.h"

#include <atomic>
#include <exception>
#include <utility>

#include "core/plugin/floating_point.h"
#include "core/plugin/state_watch.h"

namespace kerf {

namespace {

std::atomic<ThrowHandler> throw_handler{nullptr};
thread_local const kerf_component* changed_by = nullptr;  // of the floating-point unit

/// Restores the control words of the floating-point unit.
class FloatingPointGuard {
public:
    explicit FloatingPointGuard(const kerf_component& component) noexcept
        : component_(component), before_(floating_point()) {}
    ~FloatingPointGuard() {
        if (floating_point() == before_) return;
        set_floating_point(before_);
        changed_by = &component_;
    }
    FloatingPointGuard(const FloatingPointGuard&) = delete;
    FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

private:
    const kerf_component& component_;
    FloatingPoint before_;
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
    const CallNote note(call, component);
    const FloatingPointGuard guard(component);
    try {
        return work();
    } catch (...) {
        end_by_exception();
    }
}

/// Runs a call that may wait, and compares the state of the process while the call is still in progress.
template <class Work>
auto run_slow_call(PluginCall call, const kerf_component& component, const Work& work) noexcept {
    return run_call(call, component, [&] {
        const auto result = work();
        check_state();
        return result;
    });
}

}  // namespace

kerf_status call_shape(const kerf_component& tool, const double* parameters, kerf_tool_shape& out) noexcept {
    return run_slow_call(PluginCall::shape, tool, [&] { return tool.tool->shape(parameters, &out); });
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
    return run_slow_call(PluginCall::find, driver, [&] { return driver.device->find(parameters, found, capacity); });
}

kerf_status call_open(const kerf_component& driver, const kerf_device_open_in& in, std::int32_t (*is_cancelled)(void*),
                      void* context, kerf_device_open_out& out) noexcept {
    return run_slow_call(PluginCall::open, driver,
                         [&] { return driver.device->open(&in, is_cancelled, context, &out); });
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

void call_problem(const kerf_component& driver, void* device, char text[240]) noexcept {
    run_slow_call(PluginCall::problem, driver, [&] {
        driver.device->problem(device, text);
        return 0;
    });
}

bool take_changed_floating_point(const kerf_component& component) noexcept {
    return std::exchange(changed_by, nullptr) == &component;
}

void set_throw_handler(ThrowHandler handler) noexcept { throw_handler.store(handler); }

}  // namespace kerf
