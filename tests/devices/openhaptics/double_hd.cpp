// SPDX-License-Identifier: Apache-2.0
// A stand-in for libHD: one Touch, with the names and types of the maker's functions as public programs use them, and a
// servo thread of its own at 1 kHz. Built with DOUBLE_HD_IS_OLD it lacks one function, as an old version does.
#include "tests/devices/openhaptics/double_hd.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>

namespace {

constexpr unsigned handle = 0;
constexpr double max_force = 3.3, continuous_force = 0.88;  // [N]

/// Some numbers that one thread writes and others read, never half.
template <int count>
class Numbers {
public:
    void put(const double* values) {
        version_.fetch_add(1);
        for (int i = 0; i < count; ++i) values_[i].store(values[i]);
        version_.fetch_add(1);
    }
    void get(double* values) const {
        for (;;) {
            const unsigned before = version_.load();
            for (int i = 0; i < count; ++i) values[i] = values_[i].load();
            if (before % 2 == 0 && version_.load() == before) return;
        }
    }

private:
    std::atomic<double> values_[count] = {};
    std::atomic<unsigned> version_{0};
};

struct Error {
    unsigned code;
    int internal;
    unsigned device;
};

std::atomic<long> values[double_hd_value_count];
Numbers<17> pose;  // and the buttons
Numbers<3> force;
double next_force[3] = {};
bool is_in_frame = false;
std::mutex error_mutex, callback_mutex;
std::deque<Error> errors;
std::thread servo;
std::atomic<bool> is_ending{false};
unsigned (*callback)(void*) = nullptr;
void* context = nullptr;

void fail(unsigned code, int internal = 0) {
    const std::lock_guard<std::mutex> lock(error_mutex);
    if (errors.size() < 8) errors.push_back({code, internal, handle});
}

// As public programs found: calibration works in the servo's thread alone, and the first frames of a scheduler fail and
// have a pose that is made up.
thread_local bool is_servo = false;
constexpr int unready_periods = 2;
std::atomic<int> servo_periods{0};

void run_servo() {
    is_servo = true;
    servo_periods = 0;
    auto next = std::chrono::steady_clock::now();
    while (!is_ending) {
        next = std::max(next + std::chrono::milliseconds(1), std::chrono::steady_clock::now());
        std::this_thread::sleep_until(next);
        const std::lock_guard<std::mutex> lock(callback_mutex);
        if (values[double_hd_is_stalled] != 0 || callback == nullptr) continue;
        if (++servo_periods <= unready_periods) fail(0x401);
        if (callback(context) == 0) callback = nullptr;
    }
}

void make_no_force() {
    const double none[3] = {};
    force.put(none);
}

}  // namespace

extern "C" {

void double_hd_reset() {
    for (auto& value : values) value = 0;
    values[double_hd_is_plugged] = 1;
    values[double_hd_calibration] = 0x5000;
    values[double_hd_styles] = 4;
    const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    double_hd_set_pose(identity, 0);
    make_no_force();
    const std::lock_guard<std::mutex> lock(error_mutex);
    errors.clear();
}
void double_hd_set_pose(const double transform[16], int buttons) {
    double all[17];
    std::memcpy(all, transform, 16 * sizeof(double));
    all[16] = buttons;
    pose.put(all);
}
void double_hd_force(double made[3]) { force.get(made); }
void double_hd_set(int value, long to) {
    if (value == double_hd_error)
        fail(static_cast<unsigned>(to));
    else
        values[value] = to;
}
long double_hd_get(int value) { return values[value]; }

unsigned hdInitDevice(const char* name) {
    if (values[double_hd_is_running] != 0) ++values[double_hd_wrong_calls];
    if (values[double_hd_is_plugged] == 0) {
        fail(0x302, -28);
        return 0xffffffffu;
    }
    if (values[double_hd_refusals] > 0) {
        --values[double_hd_refusals];
        fail(0x301);
        return 0xffffffffu;
    }
    const char* const accepted[] = {nullptr, "Default PHANToM", "my touch"};
    const char* const wanted = accepted[values[double_hd_accepted_name]];
    if (wanted != nullptr && (name == nullptr || std::strcmp(name, wanted) != 0)) {
        fail(0x303);
        return 0xffffffffu;
    }
    return handle;
}
void hdDisableDevice(unsigned) {
    values[double_hd_is_enabled] = 0;
    make_no_force();
}
unsigned hdGetCurrentDevice() { return handle; }
void hdMakeCurrentDevice(unsigned) {}
void hdBeginFrame(unsigned) {
    if (is_in_frame) fail(0x400);
    is_in_frame = true;
    if (values[double_hd_is_plugged] == 0) fail(0x302, -28);
}
void hdEndFrame(unsigned) {
    if (!is_in_frame) fail(0x401);
    is_in_frame = false;
    const double size = std::hypot(next_force[0], next_force[1], next_force[2]);
    if (size > max_force + 1e-9) fail(0x201);
    const bool makes =
        values[double_hd_is_enabled] != 0 && values[double_hd_is_plugged] != 0 && size <= max_force + 1e-9;
    if (makes)
        force.put(next_force);
    else
        make_no_force();
    ++values[double_hd_frames];
}
Error hdGetError() {
    const std::lock_guard<std::mutex> lock(error_mutex);
    if (errors.empty()) return {0, 0, handle};
    const Error first = errors.front();
    errors.pop_front();
    return first;
}
void hdEnable(unsigned capability) {
    if (capability == 0x4000) values[double_hd_is_enabled] = 1;
}
void hdGetIntegerv(unsigned name, int* to) {
    double all[17];
    pose.get(all);
    if (name == 0x2000) *to = static_cast<int>(all[16]);
    if (name == 0x2555) *to = static_cast<int>(values[double_hd_styles]);
}
void hdGetDoublev(unsigned name, double* to) {
    double all[17];
    pose.get(all);
    if (name == 0x2052) std::memcpy(to, all, 16 * sizeof(double));
    if (name == 0x2052 && servo_periods <= unready_periods) to[12] = 0.0, to[13] = -110.0, to[14] = -35.0;
    if (values[double_hd_is_silent_of_facts] != 0) return;
    if (name == 0x2602) *to = 0.5;
    if (name == 0x2603) *to = max_force;
    if (name == 0x2604) *to = continuous_force;
    if (name == 0x2609) *to = 0.003;
}
const char* hdGetString(unsigned name) {
    if (name == 0x2501) return "Touch (stand-in)";
    return name == 0x2504 ? "T 0815" : "";
}
void hdSetDoublev(unsigned name, const double* from) {
    if (!is_in_frame) ++values[double_hd_wrong_calls];
    if (name == 0x2700) std::memcpy(next_force, from, sizeof next_force);
}
void hdStartScheduler() {
    is_ending = false;
    servo = std::thread(run_servo);
    values[double_hd_is_running] = 1;
}
void hdStopScheduler() {
    is_ending = true;
    if (servo.joinable()) servo.join();
    values[double_hd_is_running] = 0;
}
unsigned long hdScheduleAsynchronous(unsigned (*called)(void*), void* with, unsigned short) {
    const std::lock_guard<std::mutex> lock(callback_mutex);
    callback = called;
    context = with;
    values[double_hd_is_scheduled] = 1;
    return 1;
}
void hdUnschedule(unsigned long) {
    const std::lock_guard<std::mutex> lock(callback_mutex);
    callback = nullptr;
    values[double_hd_is_scheduled] = 0;
}
unsigned hdCheckCalibration() { return static_cast<unsigned>(values[double_hd_calibration].load()); }
#ifndef DOUBLE_HD_IS_OLD
void hdUpdateCalibration(unsigned) {
    if (!is_servo) return;
    ++values[double_hd_updates];
    if (values[double_hd_calibration] == 0x5001) values[double_hd_calibration] = 0x5000;
}
#endif

}  // extern "C"

namespace {
[[maybe_unused]] const bool is_ready = (double_hd_reset(), true);  // also for a program that only opens the driver
}
