// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/haptics/scene/simulation.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// A tool whose tip lies `depth` below z = 0, straight down or tilted by `tilt` [rad] about y.
[[nodiscard]] Pose at_depth(double depth, double tilt = 0.0);

/// Kerf's loop as what answers a port: a depth goes in, the force against it comes out [device newtons].
class KerfLoop {
public:
    enum class Way { solved, direct };  ///< direct: the law at the device's own rate, nothing solved

    /// Pre: `outline_of` succeeds for `setup`. `body` must outlive the loop.   [main]
    KerfLoop(const Body& body, const ToolSetup& setup, const CouplingGains& gains, double depth, Way way = Way::solved,
             double tilt = 0.0, double period = Simulation::dt);

    /// One tick, after `missed` that did not run.
    double answer(double depth, std::uint32_t missed = 0);
    /// The handle stays for `ticks`: a motor comes to its speed.
    void wait(double depth, int ticks);

    /// What the coupling's spring holds with the handle at `depth` [J, device side]; nothing where none is solved.
    [[nodiscard]] double stored(double depth) const noexcept;

    [[nodiscard]] const TickResult& last() const noexcept { return last_; }
    [[nodiscard]] Simulation& simulation() noexcept { return simulation_; }
    /// How far the tip has gone along the tool's way [m].
    [[nodiscard]] double tip() const noexcept;

private:
    Way way_;
    double tilt_;
    Simulation simulation_;
    TickResult last_;
};

}  // namespace kerf::stability
