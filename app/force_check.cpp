// SPDX-License-Identifier: Apache-2.0
#include "app/force_check.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <thread>

#include "app/confirmed_devices.h"
#include "app/interruption.h"
#include "app/own_device.h"
#include "app/standard_streams.h"
#include "core/haptics/loop/device_report.h"
#include "kerf/device_exchange.hpp"
#include "run/device/opened_device.h"

namespace kerf::app {

namespace {

constexpr double max_push = 1.0;         // [N]
constexpr double of_continuous = 0.5;    // [–] of the continuous force
constexpr double duration = 2.0;         // [s] of a push, which rises and falls
constexpr double max_speed = 0.5;        // [m/s] of the handle
constexpr double max_distance = 50e-3;   // [m] of the handle from where it was
constexpr double speed_filter = 20e-3;   // [s]
constexpr std::uint64_t max_lost = 100;  // ticks without a usable report

struct Push {
    const char* direction;  ///< for people
    Vec3 axis;              ///< frame of the device
};
constexpr Push pushes[] = {{"to the right", {1, 0, 0}}, {"up", {0, 1, 0}},    {"towards you", {0, 0, 1}},
                           {"to the left", {-1, 0, 0}}, {"down", {0, -1, 0}}, {"away from you", {0, 0, -1}}};

/// How a push went.
struct Pushed {
    std::string fault{};  ///< why it was ended early, for people; empty: it was not
    double along = 0.0;   ///< [m] by which the handle moved along the push, at the most
};

/// Reads a line from stdin; nothing at its end.
std::optional<std::string> read_line() {
    std::string line;
    for (char c = 0;;) {
        const ssize_t got = read(STDIN_FILENO, &c, 1);
        if (got <= 0) return line.empty() ? std::nullopt : std::optional(line);
        if (c == '\n') return line;
        if (line.size() < 100) line += c;
    }
}

/// Returns the reason to end a push; empty to continue.
class PushWatch {
public:
    std::string check(const kerf_device_state& state, double dt) {
        const bool is_there = (state.flags & KERF_DEVICE_VALID) != 0 && is_usable(state.device_from_handle);
        lost_ = is_there ? 0 : lost_ + 1;
        if (lost_ > max_lost) return "the device was lost.";
        if (!is_there) return "";
        const Vec3 at = state.device_from_handle.position;
        if (!start_) start_ = last_ = at;
        speed_ += dt / speed_filter * (length(at - last_) / dt - speed_);
        last_ = at;
        if (speed_ > max_speed)
            return formatted("the handle moved faster than %.1f m/s. Hold it more firmly.", max_speed);
        if (length(at - *start_) > max_distance)
            return formatted("the handle moved by more than %.0f mm. Hold it more firmly.", 1e3 * max_distance);
        return "";
    }
    [[nodiscard]] Vec3 moved() const noexcept { return start_ ? last_ - *start_ : Vec3{}; }

private:
    std::optional<Vec3> start_{};
    Vec3 last_{};
    double speed_ = 0.0;  ///< [m/s]
    std::uint64_t lost_ = 0;
};

Pushed push(run::OpenedDevice& device, Vec3 axis, double strength, const Interruption& interruption) {
    constexpr double dt = 1e-3;
    constexpr auto ticks = static_cast<std::uint64_t>(duration / dt);
    Pushed pushed;
    PushWatch watch;
    auto next = std::chrono::steady_clock::now();
    for (std::uint64_t tick = 0; tick <= ticks && pushed.fault.empty() && !interruption.has_come(); ++tick) {
        std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
        const kerf_device_state state = device.read();
        pushed.fault = watch.check(state, dt);
        pushed.along = std::max(pushed.along, dot(watch.moved(), axis));
        const double phase = std::numbers::pi * static_cast<double>(tick) / static_cast<double>(ticks);
        kerf_device_command command{};
        command.tick = tick;
        if (pushed.fault.empty()) command.force = strength * std::pow(std::sin(phase), 2) * axis;
        command.device_from_tool = state.device_from_handle;
        command.flags = KERF_DEVICE_RUNNING | KERF_DEVICE_FORCE_ON;
        device.write(command);
    }
    device.write(command_at_rest());
    return pushed;
}

/// Lets a person confirm one push. Returns `exit_pass` if it was right.
ExitCode check_push(run::OpenedDevice& device, const Push& one, double strength, const Interruption& interruption) {
    print(formatted("%s, %.1f N for %.0f s: press Enter to begin\n", one.direction, strength, duration));
    if (!read_line())
        return complain("no person answers on stdin. The force must be confirmed by hand.", exit_bad_input);
    const Pushed pushed = push(device, one.axis, strength, interruption);
    if (interruption.has_come()) return complain("interrupted; the force is off", exit_fault);
    if (!pushed.fault.empty()) {
        const std::string problem = device.problem();
        return complain("the push was ended: " + pushed.fault + (problem.empty() ? "" : " " + problem),
                        exit_not_passed);
    }
    print(formatted("  the handle moved by %.1f mm along it. Was the push %s, and gentle? Type y or n\n",
                    1e3 * pushed.along, one.direction));
    const std::optional<std::string> answer = read_line();
    if (!answer) return complain("no person answers on stdin. The force must be confirmed by hand.", exit_bad_input);
    if (*answer == "y" || *answer == "Y" || *answer == "yes") return exit_pass;
    return complain("the push " + std::string(one.direction) +
                        " was not confirmed. Do not use this device: its driver or its calibration is wrong. Write "
                        "`kerf devices doctor` and report it.",
                    exit_not_passed);
}

}  // namespace

ExitCode check_force(const std::string& id, const PluginRegistry& plugins) {
    if (id.empty())
        return complain("which device? Write `kerf devices test ID --force`; `kerf devices` shows them.",
                        exit_bad_input);
    const Interruption interruption;
    OwnDevice own;
    if (const ExitCode code = open_own_device(id, plugins, interruption, own); code != exit_pass) return code;
    run::OpenedDevice& device = *own.opened;
    if (device.record() == nullptr)
        return complain("the device `" + device.name() + "` makes no force along its axes. Leave out `--force`.",
                        exit_bad_input);
    const double strength = std::min(max_push, of_continuous * device.facts().continuous_force);
    print(device.name() +
          "\nHold the handle lightly, in the middle of its range. Let go of it at any time: the force ends by "
          "itself.\n");
    for (const Push& one : pushes)
        if (const ExitCode code = check_push(device, one, strength, interruption); code != exit_pass) return code;
    if (const std::string error = confirm(device.name()); !error.empty()) return complain(error, exit_bad_input);
    print("confirmed: the force of this device is right in all six directions\n");
    return exit_pass;
}

}  // namespace kerf::app
