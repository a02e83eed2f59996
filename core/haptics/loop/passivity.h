// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/math.hpp"

namespace kerf {

/// Limits the energy that the loop gives the hand: observer and controller, in device newtons.
///
/// The loop may give back at most the energy that the coupling's spring stores and the tool's motor supplied. Further
/// work of the hand was spent on the bone and is not credited. A plain energy sum would hide a fault behind all the
/// work of drilling. W is the energy that the loop may still give back. Below −`tolerance`, a damper takes the
/// excess back.
///
///     W ← min(W − f·Δx + supplied, V),      f_c = −c v,  c = clamp((−tolerance − W) / (T v²), 0, c_max),  v = Δx/T
///
/// f is the force on the hand, Δx its motion in a tick, V the energy stored in spring and tool, f_c the damper's force.
/// v is not filtered: after the hand has reversed, a filtered rate still points inwards and would add energy. After
/// [hannaford-ryu-2002], with V as the ceiling.
class PassivityGuard {
public:
    static constexpr double tolerance = 1e-4;  ///< [J]
    /// `unseen` [J] is the energy that a spring exchanges within one encoder count, K Δ². A hand that flickers between
    /// two counts gets it as credit. Otherwise the balance would fall without end under a still hand.
    explicit PassivityGuard(double largest_damping, double unseen = 0.0, double count = 0.0)
        : PassivityGuard({largest_damping, unseen, count}, {}) {}
    /// Damping limit and resolution of a port: the forces, or a motor about the shaft.
    struct Port {
        double largest_damping = 0.0;  ///< [N·s/m] or [N·m·s/rad]; 0: no correction at this port
        double unseen = 0.0;           ///< [J] see above
        double count = 0.0;            ///< [m] or [rad] of one encoder count
    };
    PassivityGuard(const Port& forces, const Port& shaft) : forces_(forces), shaft_(shaft) {}

    /// Sets the port of the shaft after a tool change.   [haptic, nonblocking]
    void set_shaft_port(const Port& shaft) noexcept { shaft_ = shaft; }

    /// Updates W after the hand moved by `moved` [m, rad] under the wrench on it, `wrench` [N, N·m], both world frame.
    /// The tool's motor supplied `supplied` [J], and spring and tool now store `stored` [J]. `turned` [rad] is the
    /// hand's rotation about the shaft, for a device with a motor there.   [haptic, nonblocking]
    void observe(const Vec6& wrench, const Vec6& moved, double supplied, double stored, double turned = 0.0) noexcept;
    /// Sets W to 0 when the coupling starts without stretch: energy that the hand got from a fading fault is not taken
    /// back.   [haptic, nonblocking]
    void restart() noexcept { energy_ = 0.0; }
    /// Returns the force on the hand that takes back the excess [N], world frame; 0 if W ≥ −tolerance.
    /// [haptic, nonblocking]
    [[nodiscard]] Vec3 correction(double dt) noexcept;
    /// Returns the torque on the hand about the shaft that takes back the excess left by `correction` in the same tick
    /// [N·m]. [haptic, nonblocking]
    [[nodiscard]] double shaft_correction(double dt) noexcept;

    [[nodiscard]] double energy() const noexcept { return energy_; }          ///< [J] W
    [[nodiscard]] double min_energy() const noexcept { return min_energy_; }  ///< [J] the minimum of W so far
    /// Returns the number of corrections so far, of force and of torque.
    [[nodiscard]] std::uint64_t corrections() const noexcept { return corrections_; }

private:
    Port forces_, shaft_;
    Vec3 moved_{};         ///< [m] in the last tick
    double turned_ = 0.0;  ///< [rad] about the shaft
    double left_ = 0.0;    ///< [J] excess left after the last `correction`
    double energy_ = 0.0, min_energy_ = 0.0;
    std::uint64_t corrections_ = 0;
};

}  // namespace kerf
