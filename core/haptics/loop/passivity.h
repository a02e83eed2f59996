// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/math.hpp"

namespace kerf {

/// Observer and controller of what the loop gives the hand, on the device's side.
///
/// The port may give back what the coupling's spring holds and what the tool's motor did, and no more. What the hand
/// put in beyond that was spent on the bone and is not credited: a balance that only sums would hide a fault behind all
/// the work of drilling. Where more comes out, a damper takes it back.
///
///     W ← min(W − f·Δx + supplied, V),      f_c = −c v,  c = clamp((−tolerance − W) / (T v²), 0, c_max),  v = Δx/T
///
/// The difference of one tick is taken for v, coarse as it is: a filtered rate still points inwards when the hand has
/// turned, and would give more. After [hannaford-ryu-2002], with the
/// spring's V as its ceiling.
class PassivityGuard {
public:
    static constexpr double tolerance = 1e-4;  ///< [J]
    /// `unseen` [J]: what a spring gives and takes within one count of the encoders, K Δ². A hand that flickers between
    /// two counts is credited with it, or the balance would fall for ever under a hand that stands still.
    explicit PassivityGuard(double largest_damping, double unseen = 0.0, double count = 0.0)
        : PassivityGuard({largest_damping, unseen, count}, {}) {}
    /// How a port is damped and measured: of forces, or of a motor about the shaft.
    struct Port {
        double largest_damping = 0.0;  ///< [N·s/m] or [N·m·s/rad]; 0: nothing is taken back there
        double unseen = 0.0;           ///< [J] as above
        double count = 0.0;            ///< [m] or [rad]
    };
    PassivityGuard(const Port& forces, const Port& shaft) : forces_(forces), shaft_(shaft) {}

    /// Another tool: its shaft is held by another spring.   [haptic, nonblocking]
    void serve(const Port& shaft) noexcept { shaft_ = shaft; }

    /// Since the last tick the hand moved by `moved` [m, rad] under `wrench` [N, N·m]; the motor put `supplied` [J]
    /// into the port, and the spring now holds `stored` [J].   [haptic, nonblocking]
    /// `turned` [rad]: of that, about the shaft; for a port whose motor acts there.
    void observe(const Vec6& wrench, const Vec6& moved, double supplied, double stored, double turned = 0.0) noexcept;
    /// The coupling is anchored anew: what a fault gave while it faded is not taken back from a hand that is not to
    /// blame. [haptic, nonblocking]
    void restart() noexcept { energy_ = 0.0; }
    /// The force on the hand that takes back what came out too much. [N]   [haptic, nonblocking]
    [[nodiscard]] Vec3 correction(double dt) noexcept;
    /// The torque about the shaft on the hand that takes back what `correction` of the same tick leaves. [N·m]
    /// [haptic, nonblocking]
    [[nodiscard]] double shaft_correction(double dt) noexcept;

    [[nodiscard]] double energy() const noexcept { return energy_; }       ///< [J] W
    [[nodiscard]] double least_energy() const noexcept { return least_; }  ///< [J] the lowest W has been
    [[nodiscard]] std::uint64_t corrections() const noexcept { return corrections_; }

private:
    Port forces_, shaft_;
    Vec3 moved_{};
    double turned_ = 0.0;  ///< [rad] about the shaft
    double left_ = 0.0;    ///< [J] of the excess, after the last `correction`
    double energy_ = 0.0, least_ = 0.0;
    std::uint64_t corrections_ = 0;
};

}  // namespace kerf
