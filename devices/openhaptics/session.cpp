// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kerf::openhaptics {

namespace {

constexpr int max_retries = 10;  // of a device that a program which crashed has left in use
constexpr int max_errors = 16;   // of one call
constexpr unsigned short priority = 0xffff;

std::string text_or_empty(const char* text) { return text != nullptr ? text : ""; }

/// Returns the first error since the last call, and removes all.
HdError first_error(const Hd& hd) noexcept {
    const HdError first = hd.take_error();
    HdError next = first;
    for (int i = 0; i < max_errors && next.code != 0; ++i) next = hd.take_error();
    return first;
}

std::string refusal_of(const std::string& what, const HdError& error) {
    const std::string advice = advice_for(error.code);
    return what + ": " + text_of(error) + "." + (advice.empty() ? "" : " " + advice);
}

bool may_be_in_id(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
}

}  // namespace

HdError Session::init_once(const char* name) {
    HdError error;
    for (int i = 0; i < max_retries; ++i) {
        static_cast<void>(first_error(*hd_));
        device_ = hd_->init_device(name);
        error = first_error(*hd_);
        if (error.code != hd_already_initiated) break;
        hd_->disable_device(hd_->current_device());
    }
    if (error.code == 0 && device_ == no_device) error = {.code = 0x104, .internal = 0, .device = no_device};
    if (error.code != 0) device_ = no_device;
    return error;
}

std::string Session::init(const std::string& name) {
    close();
    hd_->stop_scheduler();  // no device may be initialised while it runs
    std::vector<const char*> names = {nullptr, "Default Device", "Default PHANToM"};
    if (!name.empty()) names = {name.c_str()};
    std::string errors, newest, advice;
    for (const char* const one : names) {
        const HdError error = init_once(one);
        if (error.code == 0) {
            int styles = 0;
            hd_->get_ints(hd_calibration_style, &styles);
            styles_.store(styles, std::memory_order_relaxed);
            static_cast<void>(first_error(*hd_));
            return "";
        }
        if (advice.empty()) advice = advice_for(error.code);
        const std::string shown = one != nullptr ? "`" + std::string(one) + "`" : "the default";
        if (newest.empty())
            errors += shown;
        else
            errors += (newest == text_of(error) ? ", " : ": " + newest + "; ") + shown;
        newest = text_of(error);
    }
    return "libHD opens no device by its name. " + errors + ": " + newest + "." + (advice.empty() ? "" : " " + advice);
}

std::string Session::start() {
    hd_->make_current(device_);
    hd_->enable(hd_force_output);
    if (const HdError error = first_error(*hd_); error.code != 0)
        return refusal_of("the device does not enable its forces", error);
    hd_->start_scheduler();
    if (const HdError error = first_error(*hd_); error.code != 0)
        return refusal_of("the scheduler of libHD does not start", error);
    is_running_ = true;
    return "";
}

std::string Session::schedule(unsigned (*callback)(void*), void* context) {
    callback_ = hd_->schedule(callback, context, priority);
    if (const HdError error = first_error(*hd_); error.code != 0)
        return refusal_of("libHD does not take the servo callback", error);
    is_scheduled_ = true;
    return "";
}

unsigned Session::own_calibration() const noexcept { return preferred_style(calibration_styles()); }

void Session::close() noexcept {
    if (device_ == no_device) return;
    if (is_scheduled_) hd_->unschedule(callback_);
    if (is_running_) hd_->stop_scheduler();
    hd_->disable_device(device_);
    is_scheduled_ = is_running_ = false;
    device_ = no_device;
}

std::string Session::id() const {
    hd_->make_current(device_);
    constexpr std::size_t max_size = 40;
    std::string id = text_or_empty(hd_->get_text(hd_serial)).substr(0, max_size);
    std::replace_if(
        id.begin(), id.end(), [](char c) { return !may_be_in_id(c); }, '_');
    return id.empty() ? "default" : id;
}

std::string Session::name() const {
    hd_->make_current(device_);
    const std::string model = text_or_empty(hd_->get_text(hd_model));
    return model.empty() ? "a device of 3D Systems" : model;
}

kerf_device_facts Session::facts() const {
    hd_->make_current(device_);
    /// Returns a value of the device, or that of a Touch if it states none [chai3d].
    const auto stated = [&](unsigned name, double scale, double min, double max, double of_touch) {
        double value[64] = {};
        hd_->get_doubles(name, value);
        const double si = scale * value[0];
        return std::isfinite(si) && si > 0.0 ? std::clamp(si, min, max) : of_touch;
    };
    kerf_device_facts facts{};
    detail::copy_text(facts.name, name());
    facts.abilities = KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE;
    facts.button_count = 4;
    facts.peak_force = stated(hd_max_force, 1.0, 0.1, 40.0, 3.3);
    facts.continuous_force = std::min(facts.peak_force, stated(hd_continuous_force, 1.0, 0.05, 40.0, 0.88));
    facts.largest_stiffness = stated(hd_max_stiffness, 1e3, 10.0, 5000.0, 700.0);
    facts.largest_damping = stated(hd_max_damping, 1e3, 0.0, 30.0, 5.0);
    facts.mass = 0.045;        // [assumed]: the apparent mass that data sheets of the Touch state
    facts.resolution = 55e-6;  // [assumed]: 450 dpi, as data sheets of the Touch state
    static_cast<void>(first_error(*hd_));
    return facts;
}

}  // namespace kerf::openhaptics
