// SPDX-License-Identifier: Apache-2.0
// A stand-in for libdrd: one base, with the names and types of the maker's functions as public programs use them. Built
// with DOUBLE_DHD_IS_OLD it lacks one function, as an old version does.
#include "tests/devices/force_dimension/double_dhd.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>

namespace {

constexpr double watchdog_step = 125e-6;  // [s]
constexpr char base_id = 0;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::mutex mutex;
double_dhd_state base{.position = {},
                      .rotation = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                      .buttons = 0,
                      .is_plugged = 1,
                      .is_initialized = 1,
                      .system_type = 34,
                      .has_watchdog = 1,
                      .is_in_use = 0,
                      .force_off = 0,
                      .is_no_number = 0,
                      .force = {},
                      .is_force_on = 0,
                      .watchdog_steps = 0,
                      .moves = 0,
                      .calls = 0};
double force_time = 0.0;
const char* last_error = "no error";

int fail(const char* why) {
    last_error = why;
    return -1;
}

/// Locks, and returns whether the base answers.
class Call {
public:
    explicit Call(char id) : is_there(base.is_plugged != 0 && id == base_id) {
        if (!is_there) last_error = "error communicating with the device";
    }

private:
    std::lock_guard<std::mutex> lock_{mutex};

public:
    bool is_there;
};

}  // namespace

extern "C" {

void double_dhd_set(const double_dhd_state* state) {
    const std::lock_guard<std::mutex> lock(mutex);
    double_dhd_state next = *state;
    std::memcpy(next.force, base.force, sizeof next.force);
    next.is_force_on = base.is_force_on;
    next.watchdog_steps = base.watchdog_steps;
    next.moves = base.moves;
    next.calls = base.calls;
    base = next;
}

void double_dhd_get(double_dhd_state* state) {
    const std::lock_guard<std::mutex> lock(mutex);
    *state = base;
    const double limit = base.watchdog_steps > 0 ? base.watchdog_steps * watchdog_step : 1e9;
    if (now() - force_time > limit || base.is_plugged == 0) state->force[0] = state->force[1] = state->force[2] = 0.0;
}

int dhdGetDeviceCount() {
    const std::lock_guard<std::mutex> lock(mutex);
    return base.is_plugged;
}
int dhdOpenID(char index) {
    const Call call(index);
    if (!call.is_there) return -1;
    return base.is_in_use != 0 ? fail("device is already in use") : base_id;
}
int dhdClose(char id) { return Call(id).is_there ? 0 : -1; }
int dhdGetSystemType(char id) { return Call(id).is_there ? base.system_type : -1; }
const char* dhdGetSystemName(char /*id*/) { return "double of a base"; }
int dhdGetSerialNumber(unsigned short* number, char id) {
    *number = 4711;
    return Call(id).is_there ? 0 : -1;
}
bool dhdHasWrist(char id) { return Call(id).is_there && base.system_type != 33 && base.system_type != 60; }
int dhdEnableForce(unsigned char is_on, char id) {
    const Call call(id);
    if (!call.is_there) return -1;
    base.is_force_on = is_on;
    return 0;
}
int dhdSetForce(double x, double y, double z, char id) {
    const Call call(id);
    if (!call.is_there) return -1;
    base.force[0] = x;
    base.force[1] = y;
    base.force[2] = z;
    force_time = now();
    ++base.calls;
    return 0;
}
int dhdGetPosition(double* x, double* y, double* z, char id) {
    const Call call(id);
    if (!call.is_there) return -1;
    *x = base.is_no_number != 0 ? std::numeric_limits<double>::quiet_NaN() : base.position[0];
    *y = base.position[1];
    *z = base.position[2];
    return 1;  // not fresh: the time guard, which is no error
}
int dhdGetOrientationFrame(double rows[3][3], char id) {
    const Call call(id);
    if (!call.is_there) return -1;
    std::memcpy(rows, base.rotation, sizeof base.rotation);
    return 0;
}
int dhdGetButton(int index, char id) { return Call(id).is_there ? base.buttons >> index & 1 : -1; }
int dhdGetStatus(int values[], char id) {
    const Call call(id);
    if (!call.is_there) return -1;
    for (int i = 0; i < 17; ++i) values[i] = 0;
    values[14] = base.force_off;
    return 0;
}
int dhdSetWatchdog(unsigned char steps, char id) {
    const Call call(id);
    if (!call.is_there) return -1;
    base.watchdog_steps = base.has_watchdog != 0 ? steps : 0;
    return 0;
}
#ifndef DOUBLE_DHD_IS_OLD
int dhdGetWatchdog(unsigned char* steps, char id) {
    const Call call(id);
    *steps = static_cast<unsigned char>(base.watchdog_steps);
    return call.is_there ? 0 : -1;
}
#endif
const char* dhdErrorGetLastStr() { return last_error; }
bool drdIsInitialized(char id) { return Call(id).is_there && base.is_initialized != 0; }
int drdAutoInit(char id) {
    const Call call(id);
    if (!call.is_there) return -1;
    base.is_initialized = 1;
    ++base.moves;
    return 0;
}
int drdStop(bool /*keeps_force*/, char /*id*/) { return 0; }

}  // extern "C"
