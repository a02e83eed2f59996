// SPDX-License-Identifier: Apache-2.0
#include "wheel_link.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "devices/hid/hid_model.h"
#include "devices/hid/report_descriptor.h"
#include "devices/realtime/raised_thread.h"
#include "kerf/device_exchange.hpp"
#include "pid_codec.h"
#include "pid_layout.h"
#include "pid_motor.h"
#include "pinned_module.h"
#include "turn_counter.h"

namespace kerf::hid_force {

namespace {

constexpr auto period = std::chrono::milliseconds(1);      // between two values that are sent
constexpr auto lost_wait = std::chrono::milliseconds(20);  // between two checks of a lost device
constexpr auto close_wait = std::chrono::milliseconds(100);
constexpr double search_interval = 1.0;  // [s]
constexpr int read_ms = 5;
constexpr int max_reports = 128;  // of one reading: twice what the kernel keeps
constexpr const char* kind = "wheel or knob with force feedback (USB HID PID)";

/// A device, and what its descriptor states.
struct Wheel {
    hid::HidDevice device{};
    FoundLayout found{};
};

std::vector<Wheel> list_wheels(hid::HidTransport& transport) {
    const hid::HidModel any{
        .name = kind, .is_one = [](const hid::HidEntry&) { return true; }, .facts = nullptr, .decoder = nullptr};
    std::vector<hid::HidEntry> entries;
    std::vector<std::pair<std::string, FoundLayout>> layouts;  // by path
    std::string checked;
    std::vector<hid::HidEntry> all = transport.enumerate();
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
    for (hid::HidEntry& entry : all) {
        if (entry.path == checked) continue;  // hidapi lists a device once for each of its collections
        checked = entry.path;
        const hid::ParsedDescriptor parsed = hid::parse_descriptor(transport.descriptor(entry.path));
        if (!has_force(parsed.descriptor)) continue;
        layouts.emplace_back(entry.path, find_layout(parsed.descriptor));
        entries.push_back(std::move(entry));
    }
    std::vector<Wheel> wheels;
    for (hid::HidDevice& device : hid::devices_of(any, entries)) {
        const auto layout = std::find_if(layouts.begin(), layouts.end(),
                                         [&](const auto& one) { return one.first == device.entry.path; });
        wheels.push_back({.device = std::move(device), .found = std::move(layout->second)});
    }
    return wheels;
}

std::string name_of(const Wheel& wheel) { return wheel.device.entry.name.empty() ? "wheel" : wheel.device.entry.name; }

std::string undrivable(const std::string& problem) {
    return "it cannot be driven by HID PID: " + problem + ". Update its firmware, or take another device.";
}

/// Opens the node of a wheel. Returns the reason if it cannot. Kerf's own rules name the devices that it knows, and a
/// wheel can be anyone's.
std::string open_node(hid::HidTransport& transport, const hid::HidEntry& entry) {
    std::string refusal = transport.open(entry.path);
    if (refusal.find("permission denied") == std::string::npos) return refusal;
    std::array<char, 16> ids{};
    static_cast<void>(std::snprintf(ids.data(), ids.size(), "%04x:%04x", entry.vendor, entry.product));
    return entry.path + ": permission denied. Add a udev rule for " + ids.data() +
           ", as docs/guide/devices.md shows under `A knob`. Then plug the device in again.";
}

/// Passes texts from the driver's threads to the main thread.
class Notice {
public:
    void set(std::string text) {
        const std::lock_guard lock(mutex_);
        text_ = std::move(text);
    }
    [[nodiscard]] std::string get() const {
        const std::lock_guard lock(mutex_);
        return text_;
    }

private:
    mutable std::mutex mutex_;
    std::string text_;
};

/// Drives one wheel. Its threads own it together with the link, so that a blocked write may outlive the link.
class WheelDrive {
public:
    WheelDrive(std::unique_ptr<hid::HidTransport> transport, const WheelSetup& setup, Wheel wheel)
        : transport_(std::move(transport)), setup_(setup), wheel_(std::move(wheel)), counter_(counter()) {}

    /// Opens the device and starts its force, at zero. Returns the reason if it cannot.   [main] or the sender's thread
    [[nodiscard]] std::string open() {
        if (!wheel_.found.problem.empty()) return undrivable(wheel_.found.problem);
        if (std::string refusal = open_node(*transport_, wheel_.device.entry); !refusal.empty()) return refusal;
        motor_.emplace(*transport_, wheel_.found.layout);
        std::string refusal = motor_->begin(device_time());
        if (!refusal.empty()) {
            motor_->end();
            motor_.reset();
            transport_->close();
            return refusal;
        }
        counter_ = counter();
        hindrance_.store(Hindrance::none, std::memory_order_relaxed);
        is_lost_.store(false, std::memory_order_relaxed);
        state_.flags = KERF_DEVICE_VALID;
        exchange.put(state_, device_time());
        return {};
    }

    [[nodiscard]] double resolution() const noexcept { return counter_.resolution(); }

    /// Sends the newest torque until `end`, and searches a lost device.   [its own thread]
    void serve() noexcept {
        raise_device_thread();
        std::thread reader;
        auto next = std::chrono::steady_clock::now();
        while (!is_ending()) {
            if (is_lost_.load(std::memory_order_acquire)) {
                lose(reader);
                std::this_thread::sleep_for(lost_wait);
                if (!find_again()) continue;
            }
            if (!reader.joinable() && !begin_reading(reader)) continue;
            if (!send_newest()) {
                is_lost_.store(true, std::memory_order_release);
                continue;
            }
            next = std::max(next + period, std::chrono::steady_clock::now());
            std::this_thread::sleep_until(next);
        }
        if (motor_ && !is_lost_.load(std::memory_order_acquire)) motor_->end();
        if (reader.joinable()) reader.join();
        transport_->close();
        const std::lock_guard lock(mutex_);
        has_ended_ = true;
        ended_.notify_all();
    }

    /// Ends the threads. Returns whether they have ended in time.   [main]
    [[nodiscard]] bool end() {
        is_ending_.store(true, std::memory_order_relaxed);
        std::unique_lock lock(mutex_);
        return ended_.wait_for(lock, close_wait, [this] { return has_ended_; });
    }

    [[nodiscard]] std::string problem() const {
        std::string text = notice_.get();
        if (!text.empty()) return text;
        switch (hindrance_.load(std::memory_order_relaxed)) {
            case Hindrance::paused:
                return "the device reports that it is paused: it makes no torque. Plug it in again.";
            case Hindrance::power:
                return "the device reports that its motor has no power. Connect its power supply.";
            case Hindrance::safety_switch:
                return "the device reports that its safety switch is open. Close it, or take the wheel in your hands.";
            case Hindrance::disabled:
                return "the device reports that its motor is disabled. End other programs that use it.";
            case Hindrance::none:
                break;
        }
        return {};
    }

    DeviceExchange exchange{open_state()};

private:
    static kerf_device_state open_state() noexcept {
        kerf_device_state state = state_without_report();
        state.flags = KERF_DEVICE_VALID;
        return state;
    }
    [[nodiscard]] TurnCounter counter() const noexcept {
        const Spot& axis = wheel_.found.layout.axis.value;
        return {axis.min, std::max(axis.max, axis.min + 1), setup_.is_reversed ? -setup_.range : setup_.range};
    }
    [[nodiscard]] bool is_ending() const noexcept { return is_ending_.load(std::memory_order_relaxed); }

    /// Returns the magnitude for a torque [N·m].
    [[nodiscard]] double fraction(double torque) const noexcept {
        if (!std::isfinite(torque)) return 0.0;
        const double limit = std::min(setup_.peak_torque, setup_.full_scale_torque);
        const double sign = setup_.is_reversed != setup_.is_torque_reversed ? -1.0 : 1.0;
        return sign * std::clamp(torque, -limit, limit) / setup_.full_scale_torque;
    }

    /// Returns whether the device has taken it.
    [[nodiscard]] bool send_newest() noexcept {
        const double before = device_time();
        if (!motor_->step(fraction(exchange.command().turn_torque), before)) return false;
        // A write that blocked has sent an old force, and the effect may have ended: it must not start with that one.
        const double now = device_time();
        return now - before > DeviceExchange::silence || motor_->renew(now);
    }

    bool begin_reading(std::thread& reader) noexcept {
        try {
            reader = std::thread([this] { read_all(); });
            return true;
        } catch (const std::exception&) {
            std::this_thread::sleep_for(lost_wait);  // no thread: it tries again, and the effect runs out
            return false;
        }
    }

    void read_all() noexcept {
        raise_device_thread();
        while (!is_ending() && !is_lost_.load(std::memory_order_relaxed)) {
            bool has_turned = false;
            for (int i = 0; i < max_reports; ++i) {
                std::array<std::uint8_t, max_report> bytes{};
                const hid::HidRead read = transport_->read(bytes, i == 0 ? read_ms : 0);
                if (read.status == hid::HidRead::Status::nothing) break;
                if (read.status == hid::HidRead::Status::lost) {
                    is_lost_.store(true, std::memory_order_release);
                    return;
                }
                has_turned |= take({bytes.data(), std::min(read.size, bytes.size())});
            }
            if (has_turned) exchange.put(state_, device_time());
        }
    }

    [[nodiscard]] bool take(std::span<const std::uint8_t> report) noexcept {
        const PidLayout& layout = wheel_.found.layout;
        has_safety_switch_ |= is_safety_switch_closed(layout, report);
        if (const auto hindrance = read_state(layout, report, has_safety_switch_))
            hindrance_.store(*hindrance, std::memory_order_relaxed);
        const auto counts = read_axis(layout, report);
        if (!counts) return false;
        ++state_.reports;
        state_.turn = turn_before_ + counter_.take(*counts);
        return true;
    }

    /// Ends the reader and closes the device. Does nothing if it has been closed already.
    void lose(std::thread& reader) noexcept {
        if (reader.joinable()) reader.join();
        if (!motor_) return;
        motor_.reset();
        transport_->close();
        turn_before_ = state_.turn;
        state_.flags = 0;
        exchange.put(state_, device_time());
        next_search_ = device_time() + search_interval;
        set_notice("the device was unplugged or does not answer: it makes no torque. Plug it in; Kerf opens it again "
                   "within a second or two.");
    }

    [[nodiscard]] bool find_again() noexcept {
        if (is_ending() || device_time() < next_search_) return false;
        next_search_ = device_time() + search_interval;
        try {
            for (Wheel& found : list_wheels(*transport_)) {
                if (found.device.id != wheel_.device.id) continue;
                wheel_ = std::move(found);
                std::string refusal = open();
                set_notice(refusal);
                return refusal.empty();
            }
        } catch (const std::exception&) {
            return false;  // out of memory, perhaps: it tries again
        }
        return false;
    }

    void set_notice(const std::string& text) noexcept {
        try {
            notice_.set(text);
        } catch (const std::exception&) {
            return;  // out of memory: an older text remains
        }
    }

    std::unique_ptr<hid::HidTransport> transport_;
    WheelSetup setup_;
    Wheel wheel_;
    TurnCounter counter_;
    std::optional<PidMotor> motor_;  ///< while the device is open
    kerf_device_state state_ = open_state();
    bool has_safety_switch_ = false;
    double turn_before_ = 0.0;  ///< [rad] when the device was opened
    double next_search_ = 0.0;  ///< [s]
    Notice notice_;
    std::atomic<Hindrance> hindrance_{Hindrance::none};
    std::atomic<bool> is_lost_{false}, is_ending_{false};
    std::mutex mutex_;
    std::condition_variable ended_;
    bool has_ended_ = false;
};

class WheelLink final : public DeviceLink {
public:
    WheelLink(std::shared_ptr<WheelDrive> drive, const kerf_device_facts& facts)
        : drive_(std::move(drive)), facts_(facts), thread_([drive = drive_] { drive->serve(); }) {}
    ~WheelLink() override {
        if (!drive_->end() && pin_module())
            thread_.detach();  // a write of it blocks
        else
            thread_.join();
    }

    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return drive_->exchange.read(); }
    void write(const kerf_device_command& command) noexcept override { drive_->exchange.write(command); }
    [[nodiscard]] std::string problem() override { return drive_->problem(); }

private:
    std::shared_ptr<WheelDrive> drive_;
    kerf_device_facts facts_;
    std::thread thread_;
};

void require_setup(const WheelSetup& setup) {
    if (setup.full_scale_torque > 0.0 && setup.range > 0.0) return;
    throw std::runtime_error(std::string("the station does not state its ") +
                             (setup.full_scale_torque > 0.0 ? "range" : "full_scale_torque") +
                             ", which the device does not report. Write, with the values of its maker, "
                             "`settings: {full_scale_torque: 2.5 N m, range: 900 deg}`.");
}

}  // namespace

std::vector<DeviceFound> find_wheels(hid::HidTransport* transport) {
    if (transport == nullptr) return {{.id = "any", .name = kind, .problem = hid::lacks_hidapi}};
    std::vector<DeviceFound> found;
    for (const Wheel& wheel : list_wheels(*transport)) {
        std::string problem = open_node(*transport, wheel.device.entry);
        transport->close();
        if (problem.empty() && !wheel.found.problem.empty()) problem = undrivable(wheel.found.problem);
        found.push_back({.id = wheel.device.id,
                         .name = name_of(wheel) + ", " + wheel.device.entry.path,
                         .problem = std::move(problem)});
    }
    return found;
}

std::unique_ptr<DeviceLink> open_wheel(std::unique_ptr<hid::HidTransport> transport, const WheelSetup& setup,
                                       const DeviceRequest& request) {
    if (transport == nullptr) throw std::runtime_error(hid::lacks_hidapi);
    std::vector<Wheel> wheels = list_wheels(*transport);
    if (wheels.empty())
        throw std::runtime_error(std::string("no ") + kind +
                                 " is connected. Plug one in; `kerf devices doctor` lists the nodes of all devices.");
    const std::string id = request.id();
    const auto wheel =
        std::find_if(wheels.begin(), wheels.end(), [&](const Wheel& one) { return id.empty() || one.device.id == id; });
    if (wheel == wheels.end())
        throw std::runtime_error(std::string("no ") + kind + " with the id `" + id + "` is connected; there is `" +
                                 wheels.front().device.id + "`. `kerf devices` lists all.");
    require_setup(setup);
    if (request.is_cancelled()) throw std::runtime_error("interrupted before the device was opened");
    kerf_device_facts facts{};
    detail::copy_text(facts.name, name_of(*wheel));
    auto drive = std::make_shared<WheelDrive>(std::move(transport), setup, std::move(*wheel));
    if (const std::string refusal = drive->open(); !refusal.empty()) throw std::runtime_error(refusal);
    facts.abilities = KERF_DEVICE_TURN | KERF_DEVICE_TURN_TORQUE;
    facts.peak_turn_torque = std::min(setup.peak_torque, setup.full_scale_torque);
    facts.continuous_turn_torque = std::min(setup.continuous_torque, facts.peak_turn_torque);
    facts.turn_resolution = drive->resolution();
    return std::make_unique<WheelLink>(std::move(drive), facts);
}

}  // namespace kerf::hid_force
