// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/port.h"

#include <cmath>
#include <cstdint>

#include "kerf/assert.hpp"

namespace kerf::stability {

namespace {
constexpr int substeps = 20;
constexpr double trailing = 0.2;  // [s] of an arm that goes along [assumed]
}  // namespace

PortSettings port_of(const DeviceRecord& device, const TestHand& hand, int delay) noexcept {
    PortSettings settings;
    settings.mass = device.mass;
    settings.viscosity = device.viscosity;
    settings.friction = device.friction;
    settings.resolution = device.resolution;
    settings.hand = hand;
    settings.delay = delay;
    return settings;
}

Port::Port(const PortSettings& settings, double depth) noexcept : settings_(settings), depth_(depth), aim_(depth) {
    KERF_ASSERT(settings.delay >= 0 && settings.delay <= max_latency, "whole ticks, at most two");
}

double Port::reported() const noexcept {
    const double count = settings_.resolution;
    return count > 0.0 ? std::floor(depth_ / count + 0.5) * count : depth_;
}

void Port::place(double depth, double rate) noexcept {
    depth_ = depth;
    rate_ = rate;
}

void Port::step(double force, double push) noexcept {
    if (settings_.delay == 0) {
        held_ = force;
    } else {
        held_ = under_way_[0];
        under_way_[0] = settings_.delay == 1 ? force : under_way_[1];
        under_way_[1] = force;
    }
    integrate(push, waited_, substeps);
    waited_ = 0;
}

void Port::step_unanswered(double push) noexcept {
    if (settings_.delay > 0) held_ = under_way_[0];
    if (settings_.delay == 2) under_way_[0] = under_way_[1];
    integrate(push, 0, substeps);
}

std::uint32_t Port::wait_for_clock(double push) noexcept {
    if (settings_.clock == Clock::in_time) return 0;
    const double limit = settings_.clock == Clock::measured ? HUGE_VAL : pause_periods * settings_.period;
    const double periods = lateness_.next(limit) / settings_.period;
    const auto missed = static_cast<std::uint32_t>(periods);
    for (std::uint32_t i = 0; i < missed; ++i) step_unanswered(push);
    waited_ = static_cast<int>(substeps * (periods - missed));
    integrate(push, 0, waited_);
    return missed;
}

void Port::integrate(double push, int from, int to) noexcept {
    const double h = settings_.period / substeps, mass = settings_.moved_mass();
    const double damped = 0.5 * h * settings_.damping() / mass, stopped = h * settings_.friction / mass;
    const double began = depth_;
    for (int i = from; i < to; ++i) {
        depth_ += 0.5 * h * rate_;
        const double force = push - held_ + settings_.hand.stiffness * (aim_ - depth_);
        rate_ = (rate_ * (1.0 - damped) + h / mass * force) / (1.0 + damped);
        rate_ = std::abs(rate_) <= stopped ? 0.0 : rate_ - std::copysign(stopped, rate_);
        depth_ += 0.5 * h * rate_;
        if (goes_along_) aim_ += h / trailing * (depth_ - aim_);
    }
    work_ += held_ * (depth_ - began);
}

}  // namespace kerf::stability
