// SPDX-License-Identifier: Apache-2.0
#include "app/force_check.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include "app/confirmed_devices.h"
#include "app/interruption.h"
#include "app/own_device.h"
#include "app/standard_streams.h"
#include "core/haptics/loop/device_report.h"
#include "kerf/device_exchange.hpp"
#include "run/device/opened_device.h"

namespace kerf::app {

namespace {

constexpr double of_continuous = 0.5;    // [–] of the continuous force or torque
constexpr double duration = 2.0;         // [s] of a push, which rises and falls
constexpr double speed_filter = 20e-3;   // [s]
constexpr std::uint64_t max_lost = 100;  // ticks without a usable report

struct Push {
    const char* direction;  ///< for people
    Vec3 axis;              ///< frame of the device; of a knob (±1, 0, 0), positive clockwise
};

/// What is checked: the force on a handle, or the torque on a knob. SI.
struct Effort {
    const char* what;         ///< that it makes: "push"
    bool is_turn;             ///< a torque about the axis of a knob
    double max_strength;      ///< [N] or [N·m]
    double max_speed;         ///< [m/s] or [rad/s]
    double max_distance;      ///< [m] or [rad] from where it was
    double max_back;          ///< [m] or [rad] against the push that shows a wrong sign
    const char* unit;         ///< of the strength
    double per_distance;      ///< SI per printed unit of a distance
    const char* of_distance;  ///< that unit
    std::span<const Push> pushes;
    const char* hold;  ///< what the person does
};

constexpr Push along_axes[] = {{"to the right", {1, 0, 0}}, {"up", {0, 1, 0}},    {"towards you", {0, 0, 1}},
                               {"to the left", {-1, 0, 0}}, {"down", {0, -1, 0}}, {"away from you", {0, 0, -1}}};
constexpr Push about_the_axis[] = {{"clockwise", {1, 0, 0}}, {"counter-clockwise", {-1, 0, 0}}};
constexpr Effort of_handle{
    .what = "push",
    .is_turn = false,
    .max_strength = 1.0,
    .max_speed = 0.5,
    .max_distance = 50e-3,
    .max_back = 20e-3,
    .unit = "N",
    .per_distance = 1e-3,
    .of_distance = "mm",
    .pushes = along_axes,
    .hold = "Hold the handle lightly, in the middle of its range. Let go of it at any time: the force ends by itself."};
constexpr Effort of_knob{
    .what = "torque",
    .is_turn = true,
    .max_strength = 0.1,
    .max_speed = 2.0 * std::numbers::pi,
    .max_distance = std::numbers::pi,
    .max_back = std::numbers::pi / 18.0,
    .unit = "N m",
    .per_distance = std::numbers::pi / 180.0,
    .of_distance = "deg",
    .pushes = about_the_axis,
    .hold = "Hold the knob lightly, as you look at it. Let go of it at any time: the torque ends by itself."};

/// How a push went.
struct Pushed {
    std::string fault{};  ///< why it was ended early, for people; empty: it was not
    double along = 0.0;   ///< [m] or [rad] by which the handle moved along the push, at the most
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
    PushWatch(const Effort& effort, Vec3 axis) : effort_(effort), axis_(axis) {}
    std::string check(const kerf_device_state& state, double dt) {
        const bool is_there =
            (state.flags & KERF_DEVICE_VALID) != 0 && is_usable(state.device_from_handle) && std::isfinite(state.turn);
        lost_ = is_there ? 0 : lost_ + 1;
        if (lost_ > max_lost) return "the device was lost.";
        if (!is_there) return "";
        const Vec3 at = effort_.is_turn ? Vec3{state.turn, 0, 0} : state.device_from_handle.position;
        if (!std::exchange(has_start_, true)) start_ = last_ = at;
        speed_ += dt / speed_filter * (length(at - last_) / dt - speed_);
        last_ = at;
        if (speed_ > effort_.max_speed)
            return formatted("it moved faster than %.0f %s/s. Hold it more firmly.",
                             effort_.max_speed / effort_.per_distance, effort_.of_distance);
        if (length(at - start_) > effort_.max_distance)
            return formatted("it moved by more than %.0f %s. Hold it more firmly.",
                             effort_.max_distance / effort_.per_distance, effort_.of_distance);
        if (along() < -effort_.max_back)
            return formatted(
                "it moved by more than %.0f %s against the %s, so the sign of its driver or of its setup is "
                "wrong, or your hand moved it. Let it move by itself; if it still moves back, correct the "
                "sign.",
                effort_.max_back / effort_.per_distance, effort_.of_distance, effort_.what);
        return "";
    }
    /// Returns how far it has moved along the push.
    [[nodiscard]] double along() const noexcept { return dot(last_ - start_, axis_); }

private:
    const Effort& effort_;
    Vec3 axis_;
    bool has_start_ = false;
    Vec3 start_{}, last_{};
    double speed_ = 0.0;
    std::uint64_t lost_ = 0;
};

Pushed push(run::OpenedDevice& device, const Effort& effort, Vec3 axis, double strength,
            const Interruption& interruption) {
    constexpr double dt = 1e-3;
    constexpr auto ticks = static_cast<std::uint64_t>(duration / dt);
    Pushed pushed;
    PushWatch watch(effort, axis);
    auto next = std::chrono::steady_clock::now();
    for (std::uint64_t tick = 0; tick <= ticks && pushed.fault.empty() && !interruption.has_come(); ++tick) {
        std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
        const kerf_device_state state = device.read();
        pushed.fault = watch.check(state, dt);
        pushed.along = std::max(pushed.along, watch.along());
        const double phase = std::numbers::pi * static_cast<double>(tick) / static_cast<double>(ticks);
        kerf_device_command command{};
        command.tick = tick;
        const Vec3 made = pushed.fault.empty() ? strength * std::pow(std::sin(phase), 2) * axis : Vec3{};
        if (effort.is_turn)
            command.turn_torque = made.x;
        else
            command.force = made;
        command.device_from_tool = state.device_from_handle;
        command.flags = KERF_DEVICE_RUNNING | KERF_DEVICE_FORCE_ON;
        device.write(command);
    }
    device.write(command_at_rest());
    return pushed;
}

/// Lets a person confirm one push. Returns `exit_pass` if it was right.
ExitCode check_push(run::OpenedDevice& device, const Effort& effort, const Push& one, double strength,
                    const Interruption& interruption) {
    print(formatted("%s, %.2g %s for %.0f s: press Enter to begin\n", one.direction, strength, effort.unit, duration));
    if (!read_line())
        return complain("no person answers on stdin. The force must be confirmed by hand.", exit_bad_input);
    const Pushed pushed = push(device, effort, one.axis, strength, interruption);
    if (interruption.has_come()) return complain("interrupted; the force is off", exit_fault);
    if (!pushed.fault.empty()) {
        const std::string problem = device.problem();
        return complain(
            "the " + std::string(effort.what) + " was ended: " + pushed.fault + (problem.empty() ? "" : " " + problem),
            exit_not_passed);
    }
    print(formatted("  it moved by %.1f %s along it. Was the %s %s, and gentle? Type y or n\n",
                    pushed.along / effort.per_distance, effort.of_distance, effort.what, one.direction));
    const std::optional<std::string> answer = read_line();
    if (!answer) return complain("no person answers on stdin. The force must be confirmed by hand.", exit_bad_input);
    if (*answer == "y" || *answer == "Y" || *answer == "yes") return exit_pass;
    return complain("the " + std::string(effort.what) + " " + one.direction +
                        " was not confirmed. Do not use this device: its driver or its calibration is wrong. Write "
                        "`kerf devices doctor` and report it.",
                    exit_not_passed);
}

/// Lets a person confirm each push of a handle, or each torque of a knob.
/// @param continuous   [N] or [N·m] that the device makes for long
ExitCode check_effort(run::OpenedDevice& device, const Effort& effort, double continuous,
                      const Interruption& interruption) {
    print(std::string(effort.hold) + "\n");
    const double strength = std::min(effort.max_strength, of_continuous * continuous);
    for (const Push& one : effort.pushes)
        if (const ExitCode code = check_push(device, effort, one, strength, interruption); code != exit_pass)
            return code;
    return exit_pass;
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
    const bool has_motor = (device.facts().abilities & KERF_DEVICE_TURN_TORQUE) != 0;
    if (device.record() == nullptr && !has_motor)
        return complain("the device `" + device.name() + "` makes no force. Leave out `--force`.", exit_bad_input);
    print(device.name() + "\n");
    if (device.record() != nullptr)
        if (const ExitCode code = check_effort(device, of_handle, device.facts().continuous_force, interruption);
            code != exit_pass)
            return code;
    if (has_motor)
        if (const ExitCode code = check_effort(device, of_knob, device.facts().continuous_turn_torque, interruption);
            code != exit_pass)
            return code;
    if (const std::string error = confirm(device.name()); !error.empty()) return complain(error, exit_bad_input);
    print("confirmed: this device pushes as it should, in all directions\n");
    return exit_pass;
}

}  // namespace kerf::app
