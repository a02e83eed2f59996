// SPDX-License-Identifier: Apache-2.0
#include "openhaptics.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "servo.h"
#include "session.h"

namespace kerf::openhaptics {

namespace {

using namespace std::chrono_literals;

constexpr double between_searches = 1.0;  // [s] of a lost device
constexpr double silent_servo = 0.1;      // [s] without a period: libHD has stopped

/// The device that this process has open. libHD has one scheduler for all devices, so a search must leave it alone.
std::mutex in_use_mutex;
DeviceFound in_use;  ///< an empty id: none

/// Marks the device as the open one of this process.
class Claim {
public:
    Claim() {
        const std::lock_guard lock(in_use_mutex);
        if (!in_use.id.empty())
            throw std::runtime_error("the driver has the device `" + in_use.id +
                                     "` open already, and can open one at a time. Close that one first.");
        in_use = {.id = "default", .name = "a device of 3D Systems", .problem = ""};
    }
    ~Claim() {
        const std::lock_guard lock(in_use_mutex);
        in_use = {};
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    void name(const std::string& id, const std::string& name) const {
        const std::lock_guard lock(in_use_mutex);
        in_use = {.id = id, .name = name, .problem = ""};
    }
};

unsigned step_of(void* servo) {
    static_cast<Servo*>(servo)->step();
    return 1;  // again in the next period
}

/// An open device. libHD calls its servo; a thread of its own opens it again when it was lost.
class Link final : public DeviceLink {
public:
    /// Throws std::runtime_error if the device cannot be opened, or is not calibrated within `wait` [s].
    Link(SharedLibrary library, const DeviceRequest& request, double wait)
        : library_(std::move(library)), hd_(Hd::of(library_)), name_(request.setting("device_name")), session_(hd_) {
        if (std::string fault = session_.init(name_); !fault.empty()) throw std::runtime_error(fault);
        const std::string id = session_.id();
        if (!request.id().empty() && request.id() != id)
            throw std::runtime_error("no device with the id `" + request.id() + "` is connected; there is `" + id +
                                     "`.");
        claim_.name(id, session_.name());
        facts_ = session_.facts();
        if (std::string fault = session_.start(); !fault.empty()) throw std::runtime_error(fault);
        servo_ = std::make_unique<Servo>(hd_, facts_.peak_force);
        servo_->restart(session_.device(), session_.own_calibration());
        if (std::string fault = session_.schedule(&step_of, servo_.get()); !fault.empty())
            throw std::runtime_error(fault);
        wait_for_calibration(request, wait);
        thread_ = std::thread([this] { supervise(); });
    }
    ~Link() override {
        is_ending_.store(true, std::memory_order_relaxed);
        thread_.join();
        servo_->end();
        for (int i = 0; i < 50 && !servo_->has_ended() && !servo_->is_lost(); ++i) std::this_thread::sleep_for(1ms);
        session_.close();
    }

    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return servo_->exchange().read(); }
    void write(const kerf_device_command& command) noexcept override { servo_->exchange().write(command); }
    [[nodiscard]] std::string problem() override {
        {
            const std::lock_guard lock(mutex_);
            if (!reopening_.empty()) return reopening_;
        }
        if (const HdError error = servo_->error(); error.code != 0)
            return text_of(error) + ". " + advice_for(error.code);
        switch (servo_->fault()) {
            case ServoFault::no_pose:
                return "libHD reports a pose that is none. Switch the device off and on.";
            case ServoFault::jump:
                return "the position of the stylus jumped, so no force is made. If it happens again, calibrate the "
                       "device.";
            case ServoFault::frozen:
                return "the position rests while the stylus turns: the device is not calibrated. " +
                       calibration_advice(session_.calibration_styles());
            case ServoFault::not_calibrated:
                return "the device is not calibrated. " + calibration_advice(session_.calibration_styles());
            case ServoFault::none:
            case ServoFault::error:
                break;
        }
        if (is_silent_.load(std::memory_order_relaxed))
            return "libHD has stopped calling its servo. Check the cable of the device, or start Kerf again.";
        return "";
    }

private:
    void wait_for_calibration(const DeviceRequest& request, double wait) {
        for (const double end = device_time() + wait; !servo_->is_ready();) {
            if (request.is_cancelled()) throw std::runtime_error("interrupted before the device was calibrated");
            if (device_time() > end && servo_->error().code != 0) throw std::runtime_error(problem());
            if (device_time() > end)
                throw std::runtime_error("the device is not calibrated. " +
                                         calibration_advice(session_.calibration_styles()) + " Then start Kerf again.");
            std::this_thread::sleep_for(20ms);
        }
    }

    void supervise() noexcept {
        std::uint64_t periods = 0;
        double newest = device_time(), next_search = 0.0;
        while (!is_ending_.load(std::memory_order_relaxed)) {
            std::this_thread::sleep_for(10ms);
            const double now = device_time();
            if (const std::uint64_t count = servo_->periods(); count != periods) {
                periods = count;
                newest = now;
            }
            is_silent_.store(now - newest > silent_servo, std::memory_order_relaxed);
            if (now < next_search || !servo_->is_lost()) continue;
            next_search = now + between_searches;
            try {
                open_again();
            } catch (const std::exception&) {
                continue;  // out of memory: it tries again
            }
        }
    }

    /// Opens a device that was lost, as the maker's library needs it: from the start.
    void open_again() {
        std::string fault = session_.init(name_);
        if (fault.empty()) fault = session_.start();
        if (fault.empty()) {
            servo_->restart(session_.device(), session_.own_calibration());
            fault = session_.schedule(&step_of, servo_.get());
        }
        const std::lock_guard lock(mutex_);
        reopening_ = std::move(fault);
    }

    Claim claim_;
    SharedLibrary library_;
    Hd hd_;
    std::string name_;  ///< of the maker's setup program; empty: the default device
    std::unique_ptr<Servo> servo_;
    Session session_;  ///< ends before the servo that it calls
    kerf_device_facts facts_{};
    std::mutex mutex_;
    std::string reopening_;  ///< why the lost device could not be opened again
    std::atomic<bool> is_ending_{false}, is_silent_{false};
    std::thread thread_;
};

}  // namespace

std::vector<DeviceFound> OpenHaptics::find() const {
    {
        const std::lock_guard lock(in_use_mutex);
        if (!in_use.id.empty()) return {in_use};
    }
    if (!is_installed(places(""))) return {};
    const SharedLibrary library(places(""), true);
    const Hd hd = Hd::of(library);
    Session session(hd);
    if (const std::string fault = session.init(""); !fault.empty())
        return {{.id = "default", .name = "a device of 3D Systems", .problem = fault}};
    return {{.id = session.id(), .name = session.name(), .problem = ""}};
}

std::unique_ptr<DeviceLink> OpenHaptics::open(const DeviceRequest& request) const {
    request.require_known_settings({"library", "device_name"});
    return std::make_unique<Link>(SharedLibrary(places(request.setting("library")), true), request, wait);
}

}  // namespace kerf::openhaptics
