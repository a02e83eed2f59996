// SPDX-License-Identifier: Apache-2.0
#include "arm_session.h"

#include <utility>

#include "kerf/device_exchange.hpp"

namespace kerf::haply {

namespace {

constexpr double trial_force = 0.05;  // [N] upwards
constexpr double shown_force = 0.02;  // [N] the service shows more once it has taken the trial
constexpr int trials_of_a_word = 40;  // messages

}  // namespace

std::string fault_of(const Arm& arm) {
    if (!arm.has_power) return "the arm has no power. Connect its power supply.";
    if (!arm.is_ready) return "the arm is not ready. Wait until its lamp is calm, or switch it off and on.";
    if (!arm.is_calibrated)
        return "the arm is not calibrated, so it must make no force. Put its grip into the inkwell until the lamp "
               "changes, as its manual shows, then start again.";
    return {};
}

ArmSession::ArmSession(std::string wanted, std::optional<ForceWord> word)
    : wanted_(std::move(wanted)), stated_word_(word), state_(state_without_report()) {}

void ArmSession::begin() noexcept {
    phase_ = Phase::waits;
    trials_ = 0;
    problem_.clear();
}

bool ArmSession::refuse(std::string problem) {
    phase_ = Phase::refused;
    problem_ = std::move(problem);
    state_.flags = 0;
    return false;
}

bool ArmSession::take(std::string_view message) {
    std::string fault;
    const std::optional<ServiceState> state = read_state(message, fault);
    if (!state)
        return refuse("it sent a message that is none of Haply's Inverse Service: " + fault +
                      ". Check `port`; the service must be of version 3.1 or newer.");
    if (phase_ == Phase::refused) return false;
    if (phase_ == Phase::waits) return choose(*state);
    const Arm* const arm = state->arm(arm_);
    if (phase_ == Phase::tries && arm != nullptr && !try_word(*arm)) return false;
    take_state(*state);
    return true;
}

bool ArmSession::choose(const ServiceState& message) {
    if (message.arms.empty())
        return refuse("the service runs, but no Inverse3 or Minverse is connected to it. Check cable and power.");
    const Arm* const arm = wanted_.empty() ? &message.arms.front() : message.arm(wanted_);
    if (arm == nullptr)
        return refuse("no arm with the id `" + wanted_ + "` is connected; there is `" + message.arms.front().id +
                      "`. `kerf devices` lists all.");
    if (std::string fault = fault_of(*arm); !fault.empty()) return refuse(std::move(fault));
    if (arm->is_in_use) return refuse(in_use);
    if (!arm->position) return refuse("the arm reports no position. Switch it off and on.");
    arm_ = wanted_ = arm->id;
    type_ = arm->type;
    if (grip_.empty() && !message.grips.empty()) grip_ = message.grips.front().id;
    has_grip_ = has_grip_ || !grip_.empty();
    configures_ = message.has_session;
    must_introduce_ = true;
    const bool shows_force = arm->force.has_value();
    if (stated_word_ || !shows_force) {
        word_ = stated_word_.value_or(ForceWord::values);
        knows_word_ = true;
    } else if (!knows_word_) {
        word_ = ForceWord::vector;
    }
    phase_ = knows_word_ ? Phase::runs : Phase::tries;
    take_state(message);
    return true;
}

/// Returns false if the service takes neither word.
bool ArmSession::try_word(const Arm& arm) {
    if (arm.force && length(*arm.force) > shown_force) {
        knows_word_ = true;
        phase_ = Phase::runs;
        return true;
    }
    if (++trials_ < trials_of_a_word) return true;
    if (trials_ >= 2 * trials_of_a_word)
        return refuse("the service makes no force for any command that Kerf knows. Write `settings: {service: 3.1}` or "
                      "`3.5` in the station, and please report the version of the service.");
    word_ = ForceWord::values;
    return true;
}

void ArmSession::take_state(const ServiceState& message) {
    const Arm* const arm = message.arm(arm_);
    const Grip* const grip = has_grip_ ? message.grip(grip_) : nullptr;
    problem_.clear();
    if (arm == nullptr)
        problem_ = "the arm is unplugged. Check cable and power.";
    else if (problem_ = fault_of(*arm); problem_.empty() && !arm->position)
        problem_ = "the arm reports no position. Switch it off and on.";
    if (problem_.empty() && has_grip_ && (grip == nullptr || !grip->rotation))
        problem_ = "the grip reports no rotation. Press one of its buttons, or charge it.";
    state_.flags = problem_.empty() ? std::uint32_t{KERF_DEVICE_VALID} : 0;
    if (!problem_.empty()) return;
    ++state_.reports;
    state_.device_from_handle.position = *arm->position;
    if (grip == nullptr) return;
    state_.device_from_handle.rotation = *grip->rotation;
    state_.buttons = grip->buttons;
}

std::string ArmSession::command(Vec3 force) {
    if (std::exchange(must_introduce_, false)) return first_command(arm_, word_, configures_);
    if (phase_ == Phase::tries) return force_command(arm_, word_, {0.0, trial_force, 0.0});
    return force_command(arm_, word_, force);
}

bool ArmSession::concerns(const ServiceEvent& event) const noexcept {
    return event.device.empty() || event.device == arm_ || event.device == grip_;
}

}  // namespace kerf::haply
