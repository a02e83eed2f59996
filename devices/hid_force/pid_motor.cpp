// SPDX-License-Identifier: Apache-2.0
#include "pid_motor.h"

#include <algorithm>

namespace kerf::hid_force {

namespace {

constexpr double gain_interval = 20e-3;  // [s] while the gain rises

std::string not_taken(const char* report) {
    return std::string("the device does not take the report `") + report + "`. Plug it in again.";
}

}  // namespace

bool PidMotor::send(const Report& report) noexcept {
    return report.kind == hid::ReportKind::feature ? transport_->send_feature(report.data())
                                                   : transport_->send(report.data());
}

BlockLoad PidMotor::poll_block() noexcept {
    BlockLoad load{};
    for (int i = 0; i < max_polls && load.status == BlockLoad::Status::pending; ++i) {
        Report report{.bytes = {}, .size = layout_.load.message.size, .kind = hid::ReportKind::feature};
        report.bytes[0] = layout_.load.message.id;
        const std::size_t size = transport_->get_feature({report.bytes.data(), report.size});
        load = read_block_load(layout_, {report.bytes.data(), std::min(size, report.size)});
    }
    return load;
}

std::string PidMotor::create() {
    using Status = BlockLoad::Status;
    if (!send(create_report(layout_))) return not_taken("create new effect");
    const BlockLoad load = poll_block();
    switch (load.status) {
        case Status::success:
            block_ = load.block;
            return {};
        case Status::full:
            return "the device has no memory for another effect. Plug it in again, and end other programs that use it.";
        case Status::error:
            return "the device refuses a constant force (`block load`). Its firmware may need an update.";
        case Status::pending:
            break;
    }
    return "the device does not answer to `create new effect`: its `block load` was read " + std::to_string(max_polls) +
           " times. Plug it in again.";
}

std::string PidMotor::begin(double now) {
    block_ = 0;
    // Effects of a program that ended without freeing them fill the device, and those without end would play on:
    // OpenFFBoard only pauses them when all are stopped, and continues them when the actuators are enabled.
    if (layout_.control.reset.exists() && !send(control_report(layout_, layout_.control.reset)))
        return not_taken("device control");
    if (!send(control_report(layout_, layout_.control.stop_all)) ||
        !send(control_report(layout_, layout_.control.enable)))
        return not_taken("device control");
    began_ = gained_ = now;
    if (layout_.gain.message.exists()) {
        gain_ = gain_report(layout_, 0.0);
        if (!send(gain_)) return not_taken("device gain");
    }
    if (std::string refusal = create(); !refusal.empty()) return refusal;
    force_ = force_report(layout_, block_, 0.0);
    if (!send(effect_report(layout_, block_))) return not_taken("set effect");
    if (!send(force_)) return not_taken("set constant force");
    if (!send(operation_report(layout_, block_, layout_.operation.start))) return not_taken("effect operation");
    started_ = now;
    return {};
}

bool PidMotor::send_gain(double now) noexcept {
    const double fraction = std::clamp((now - began_) / ramp, 0.0, 1.0);
    if (now - gained_ < gain_interval && fraction < 1.0) return true;
    const Report report = gain_report(layout_, fraction);
    gained_ = now;
    if (report.bytes == gain_.bytes) return true;
    gain_ = report;
    return send(report);
}

bool PidMotor::step(double fraction, double now) noexcept {
    if (layout_.gain.message.exists() && !send_gain(now)) return false;
    const double risen = std::clamp((now - began_) / ramp, 0.0, 1.0);
    const Report report = force_report(layout_, block_, risen * fraction);
    if (report.bytes == force_.bytes) return true;
    force_ = report;
    return send(report);
}

bool PidMotor::renew(double now) noexcept {
    if (now - started_ < start_interval) return true;
    started_ = now;
    return send(operation_report(layout_, block_, layout_.operation.start));
}

void PidMotor::end() noexcept {
    if (block_ == 0) return;
    // Each is tried even if one before it fails.
    static_cast<void>(send(force_report(layout_, block_, 0.0)));
    static_cast<void>(send(operation_report(layout_, block_, layout_.operation.stop)));
    if (layout_.free.message.exists()) static_cast<void>(send(free_report(layout_, block_)));
    block_ = 0;
}

}  // namespace kerf::hid_force
