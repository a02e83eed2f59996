// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "studies/plan/scene_model.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::plan {

/// What a tool met on its way, a sample a tick.
struct Met {
    std::vector<Vec3> force;     ///< [N] bone on tool, world frame
    std::vector<double> torque;  ///< [N·m] about the shaft
    double removed = 0.0;        ///< [m³]
    double removes = 0.0;        ///< [–] share of the ticks in which it cut
};

/// [µs] of the processor per tick: what other programs take meanwhile is not counted.
struct Cost {
    double median = 0.0, p999 = 0.0, longest = 0.0;
};

/// Takes the tool along the way at its feed, after its motor has come to its speed: the law at a prescribed motion.
/// Error: the tool cannot be made.   [main]
[[nodiscard]] bool go(const Body& body, const ToolSetup& setup, const Way& way, Met& met, std::string& error);

/// The same led by a hand on a coupling, as a run does it, and what a tick of it costs.   [main]
[[nodiscard]] Cost cost_of(const Body& body, const ToolSetup& setup, const CouplingGains& gains, const Way& way);

/// How far two ways of modelling are apart [–].
struct Apart {
    double force = 0.0;   ///< RMS|F − F_ref| / RMS|F_ref|
    double torque = 0.0;  ///< RMS(T − T_ref) / RMS T_ref
    double volume = 0.0;  ///< |V − V_ref| / V_ref
    /// The worse of the force's error and, where it counts, the torque's: what a hand would feel of it.
    [[nodiscard]] double felt(bool torque_counts) const noexcept {
        return torque_counts ? std::max(force, torque) : force;
    }
};
[[nodiscard]] Apart apart(const Met& met, const Met& reference);

}  // namespace kerf::plan
