// SPDX-License-Identifier: Apache-2.0
#include "servo.h"

#include <algorithm>
#include <cmath>

namespace kerf::openhaptics {

namespace {

constexpr double largest_jump = 20e-3;  // [m] between two periods: no hand is so fast
constexpr double settling = 0.1;        // [s] after a jump
constexpr double longest_still = 0.2;   // [s] in which a rotating stylus keeps its position to the bit
constexpr double still_angle = 0.05;    // [rad] [assumed]: more than the noise of a resting hand
constexpr double between_checks = 0.1;  // [s] of the calibration
constexpr double error_memory = 1.0;    // [s]
constexpr int max_errors = 16;          // of one period
constexpr int needed_periods = 3;       // without an error, before a pose is believed

bool are_same(Vec3 a, Vec3 b) noexcept { return a.x == b.x && a.y == b.y && a.z == b.z; }

double angle_between(const Quat& a, const Quat& b) noexcept {
    return 2.0 * std::acos(std::min(1.0, std::abs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z)));
}

}  // namespace

void Servo::restart(unsigned device, unsigned style) noexcept {
    device_ = device;
    style_ = style;
    has_last_ = false;
    is_calibrated_ = false;
    sound_periods_ = 0;
    is_ready_.store(false, std::memory_order_release);
    next_check_ = unsound_until_ = 0.0;
    is_lost_.store(false, std::memory_order_release);
}

HdError Servo::error() const noexcept {
    if (device_time() - error_time_.load(std::memory_order_relaxed) > error_memory) return {};
    return {.code = error_code_.load(std::memory_order_relaxed),
            .internal = error_internal_.load(std::memory_order_relaxed),
            .device = 0};
}

void Servo::step() noexcept {
    const double now = device_time();
    double transform[16] = {};
    int buttons = 0;
    hd_->begin_frame(device_);
    hd_->get_doubles(hd_transform, transform);
    hd_->get_ints(hd_buttons, &buttons);
    check_calibration(now);
    take(now, transform, buttons);
    const bool is_ending = is_ending_.load(std::memory_order_acquire);
    Vec3 force{};
    if (!is_ending && (state_.flags & KERF_DEVICE_VALID) != 0) force = exchange_.command().force;
    if (!is_finite(force)) force = {};
    if (const double size = length(force); size > peak_force_) force = (peak_force_ / size) * force;
    const double values[3] = {force.x, force.y, force.z};
    hd_->set_doubles(hd_force, values);
    hd_->end_frame(device_);
    const int before = sound_periods_;
    sound_periods_ = note_errors(now) ? std::min(before + 1, needed_periods) : 0;
    if (before < needed_periods && sound_periods_ == needed_periods)
        error_code_.store(0, std::memory_order_relaxed);  // those of the beginning mean nothing
    exchange_.put(state_, now);
    is_ready_.store((state_.flags & KERF_DEVICE_VALID) != 0, std::memory_order_release);
    periods_.fetch_add(1, std::memory_order_relaxed);
    if (is_ending) has_ended_.store(true, std::memory_order_release);
}

void Servo::check_calibration(double now) noexcept {
    if (now < next_check_) return;
    next_check_ = now + between_checks;
    unsigned state = hd_->check_calibration();
    if (state == hd_needs_update && style_ != 0) {  // libHD takes this from its own thread alone
        hd_->update_calibration(style_);
        state = hd_->check_calibration();
    }
    is_calibrated_ = state == hd_calibrated;
}

void Servo::take(double now, const double (&transform)[16], int buttons) noexcept {
    const std::optional<Pose> pose = pose_of(transform);
    const ServoFault fault = pose ? fault_of(now, *pose) : ServoFault::no_pose;
    fault_.store(fault, std::memory_order_relaxed);
    state_.flags = fault == ServoFault::none && !is_lost() && sound_periods_ == needed_periods
                       ? std::uint32_t{KERF_DEVICE_VALID}
                       : 0;
    if (state_.flags == 0) return;
    ++state_.reports;
    state_.device_from_handle = *pose;
    state_.buttons = static_cast<std::uint32_t>(buttons) & 0xfu;
}

ServoFault Servo::fault_of(double now, const Pose& pose) noexcept {
    if (has_last_ && length(pose.position - last_.position) > largest_jump) unsound_until_ = now + settling;
    if (!has_last_ || !are_same(pose.position, last_.position)) {
        still_since_ = now;
        still_ = pose.rotation;
    }
    last_ = pose;
    has_last_ = true;
    if (!is_calibrated_) return ServoFault::not_calibrated;
    if (now < unsound_until_) return ServoFault::jump;
    const bool is_frozen = now - still_since_ > longest_still && angle_between(still_, pose.rotation) > still_angle;
    if (is_frozen || (fault_.load(std::memory_order_relaxed) == ServoFault::frozen && now > still_since_))
        return ServoFault::frozen;
    return ServoFault::none;
}

/// Notes the errors of a period. Returns whether there were none.
bool Servo::note_errors(double now) noexcept {
    bool is_sound = true;
    for (int i = 0; i < max_errors; ++i) {
        const HdError error = hd_->take_error();
        if (error.code == 0) break;
        error_code_.store(error.code, std::memory_order_relaxed);
        error_internal_.store(error.internal, std::memory_order_relaxed);
        error_time_.store(now, std::memory_order_relaxed);
        // An error of the force passes by; the device still reports its pose.
        if (error.code >= hd_warm_motors && error.code <= hd_last_of_force) continue;
        is_sound = false;
        state_.flags = 0;
        fault_.store(ServoFault::error, std::memory_order_relaxed);
        if (error.code >= hd_fault && error.code <= hd_timer_error) is_lost_.store(true, std::memory_order_release);
    }
    return is_sound;
}

}  // namespace kerf::openhaptics
