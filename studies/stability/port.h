// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/haptics/loop/device_record.h"
#include "studies/stability/lateness.h"
#include "studies/stability/test_hand.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// A haptic device with a hand on it, along one axis. Device newtons.
struct PortSettings {
    double mass = 0.075;      ///< [kg] of the device
    double viscosity = 0.1;   ///< [N·s/m] of the device
    double friction = 0.0;    ///< [N] Coulomb
    double resolution = 0.0;  ///< [m] of one encoder count; 0: exact
    TestHand hand = no_hand;
    double period = 1e-3;  ///< [s] T: a force is held as long
    int delay = 0;         ///< whole ticks from a sample to the force that answers it, 0 … longest_latency
    Clock clock = Clock::in_time;

    [[nodiscard]] double moved_mass() const noexcept { return mass + hand.mass; }
    [[nodiscard]] double damping() const noexcept { return viscosity + hand.damping; }
};
[[nodiscard]] PortSettings port_of(const DeviceRecord& device, const TestHand& hand, int delay) noexcept;

/// The plant behind a sampled force: device and hand as one mass, integrated in steps of T/20 and less.
///
///     (m + m_h) ẍ = push − f(t − t_d) − (b + b_h) ẋ − f_c sign ẋ + k_h (aim − x)
///
/// with f the held force against x. Each step is half a drift, a kick with the damping taken at its middle, half a
/// drift: second order, so that the phase lost is the sampling's. Friction stops the mass and never turns it back.
/// x is the depth: positive towards the bone.
class Port {
public:
    /// At rest at `depth` [m], where the hand aims.
    Port(const PortSettings& settings, double depth) noexcept;

    /// What the encoder says [m].
    [[nodiscard]] double reported() const noexcept;
    /// One period, after the loop has answered the sample with `force` [N] against the depth; the hand pushes with
    /// `push` [N] on top of what its own spring does.
    void step(double force, double push) noexcept;
    /// One period in which the loop does not answer: the device holds what it has.
    void step_unanswered(double push) noexcept;
    /// On the clock: keeps the held force until the loop is called. `step` then has the rest of the period.
    /// Returns the number of whole periods that passed unanswered; 0 without a clock.
    std::uint32_t wait_for_clock(double push) noexcept;

    /// The hand's aim trails its handle by 0.2 s: an arm that goes along. Otherwise it stays where it is.
    void go_along(bool does) noexcept { goes_along_ = does; }
    void aim_here() noexcept { aim_ = depth_; }
    void place(double depth, double rate) noexcept;

    [[nodiscard]] double depth() const noexcept { return depth_; }  ///< [m] as it is
    [[nodiscard]] double rate() const noexcept { return rate_; }    ///< [m/s]
    [[nodiscard]] double held() const noexcept { return held_; }    ///< [N] what the device made in the last period
    /// Returns the work of the hand against the held force so far [J].
    [[nodiscard]] double work() const noexcept { return work_; }
    [[nodiscard]] const PortSettings& settings() const noexcept { return settings_; }

private:
    /// Integrates from one substep of the period to another.
    void integrate(double push, int from, int to) noexcept;

    PortSettings settings_;
    double depth_, rate_ = 0.0, aim_, held_ = 0.0, work_ = 0.0;
    int waited_ = 0;  ///< substeps of this period that passed before the loop was called
    Lateness lateness_{};
    bool goes_along_ = false;
    std::array<double, max_latency> under_way_{};  ///< forces that have not arrived, the oldest first
};

}  // namespace kerf::stability
