// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "kerf/exact_math.hpp"
#include "tests/run/doubled_device.h"

namespace kerf::run {

/// Takes the part of a knob with a motor. Any thread calls its functions.
class KnobStandIn {
public:
    virtual ~KnobStandIn() = default;
    /// @param turn  [rad] since the start, positive clockwise
    virtual void set_turn(double turn) = 0;
    /// Returns the torque that it makes now [N·m], positive clockwise.
    [[nodiscard]] virtual double torque() = 0;
};

/// A stylus that leads the tool but for its turn about the shaft, which a knob leads. What the hand turns about the
/// shaft goes to the knob, the rest to the stylus.
class StylusAndKnob final : public StandIn {
public:
    StylusAndKnob(StandIn& stylus, KnobStandIn& knob) : stylus_(stylus), knob_(knob) {}
    void set_handle(const Pose& device_from_handle, std::uint32_t buttons) override {
        const Quat& now = device_from_handle.rotation;
        if (has_last_) {
            const Quat change = conjugate(last_) * now;
            turn_ += std::remainder(2.0 * std::atan2(change.z, change.w), 2.0 * 3.14159265358979323846);
        }
        last_ = now;
        has_last_ = true;
        const SinCos half = sin_cos_exact(-0.5 * turn_);
        stylus_.set_handle({device_from_handle.position, normalized(now * Quat{half.cos, 0, 0, half.sin})}, buttons);
        knob_.set_turn(turn_);
    }
    [[nodiscard]] Vec3 force() override { return stylus_.force(); }
    [[nodiscard]] Vec3 torque() override { return knob_.torque() * rotate(last_, {0, 0, 1}); }

private:
    StandIn& stylus_;
    KnobStandIn& knob_;
    Quat last_{};
    bool has_last_ = false;
    double turn_ = 0.0;  ///< [rad]
};

}  // namespace kerf::run
