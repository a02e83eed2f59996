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
    enum class Rendering { solved, direct };  ///< direct: the law at the device's own rate, nothing solved

    /// Pre: `outline_of` succeeds for `setup`. `body` must outlive the loop.   [main]
    KerfLoop(const Body& body, const ToolSetup& setup, const CouplingGains& gains, double depth,
             Rendering rendering = Rendering::solved, double tilt = 0.0, double period = Simulation::dt);

    /// Turns the handle about the shaft by `by` [rad], in the direction that tightens a screw.
    void turn(double by) noexcept { turned_ += by; }
    /// One tick, after `missed` that did not run.
    double answer(double depth, std::uint32_t missed = 0);
    /// The handle stays for `ticks`: a motor comes to its speed.
    void wait(double depth, int ticks);

    /// What the coupling's spring holds with the handle at `depth` [J, device side]; nothing where none is solved.
    [[nodiscard]] double stored(double depth) const noexcept;

    [[nodiscard]] const TickResult& last() const noexcept { return last_; }
    [[nodiscard]] Simulation& simulation() noexcept { return simulation_; }
    /// Returns the distance of the tip along its path [m].
    [[nodiscard]] double tip() const noexcept;

private:
    [[nodiscard]] Pose handle_at(double depth) const noexcept;

    Rendering rendering_;
    double tilt_, turned_ = 0.0;
    Simulation simulation_;
    TickResult last_;
};

}  // namespace kerf::stability
