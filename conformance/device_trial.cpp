// SPDX-License-Identifier: Apache-2.0
#include "conformance/device_trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "core/plugin/plain_text.h"
#include "core/plugin/plugin_call.h"

namespace kerf::conformance {

std::vector<double> defaults_of(const kerf_component& driver) {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < driver.param_count; ++i) values.push_back(driver.params[i].def);
    return values;
}

Opening open_device(const kerf_component& driver, const OpenRequest& request) {
    using Clock = std::chrono::steady_clock;
    const std::vector<double> params = defaults_of(driver);
    std::vector<kerf_device_setting> settings;
    for (const auto& [key, value] : request.settings) settings.push_back({key.c_str(), value.c_str()});
    const kerf_device_open_in in{.id = request.id.c_str(),
                                 .params = params.data(),
                                 .settings = settings.data(),
                                 .setting_count = static_cast<std::uint32_t>(settings.size()),
                                 .reserved = 0};
    auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(request.patience));
    const auto is_over = [](void* context) {
        return Clock::now() >= *static_cast<const Clock::time_point*>(context) ? std::int32_t{1} : std::int32_t{0};
    };
    Opening opening;
    opening.status = call_open(driver, in, is_over, &end, opening.out);
    return opening;
}

std::string DeviceTrial::reason() const {
    const auto& message = opening_.out.message;
    const std::string words(message, std::find(std::begin(message), std::end(message), '\0'));
    return "without settings it opens no device: " + quoted_plain(words) + ". With a device more is tested";
}

kerf_device_state DeviceTrial::read() const noexcept {
    kerf_device_state state{};
    call_read(driver_, opening_.out.device, state);
    return state;
}

void DeviceTrial::write(const kerf_device_command& command) const noexcept {
    call_write(driver_, opening_.out.device, command);
}

void DeviceTrial::close() noexcept {
    if (!is_open()) return;
    call_close(driver_, opening_.out.device);
    opening_.out.device = nullptr;
}

kerf_device_command gentle_command(std::uint64_t tick, const kerf_device_state& state) noexcept {
    constexpr double force = 0.05, turning = 5e-3;  // [N], [rad] a tick
    const double angle = turning * static_cast<double>(tick);
    kerf_device_command command{};
    command.tick = tick;
    command.force = {force * std::cos(angle), force * std::sin(angle), 0.0};
    command.device_from_tool = state.device_from_handle;
    command.flags = KERF_DEVICE_RUNNING | KERF_DEVICE_FORCE_ON;
    return command;
}

}  // namespace kerf::conformance
