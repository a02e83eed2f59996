// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "core/field/grid/body.h"
#include "core/haptics/loop/haptic_loop.h"

namespace kerf {

/// A law in bone without end, all edges engaged and the motor at its speed.   [main]
class EndlessBoneLaw {
public:
    /// Keeps a reference to `setup`. `tissues`: of the body.
    EndlessBoneLaw(const ToolSetup& setup, std::size_t tissues);
    ~EndlessBoneLaw();
    EndlessBoneLaw(const EndlessBoneLaw&) = delete;
    EndlessBoneLaw& operator=(const EndlessBoneLaw&) = delete;

    /// Returns the force along the tool's axis in a material of `density` [kg/m³] at a steady `feed_rate` [m/s]. [N]
    [[nodiscard]] double force(std::size_t material, double density, double feed_rate) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The force along the tool's axis that a plugin's law asks for in the body's hardest tissue at a steady `feed_rate`
/// [m/s]: what the device's force scale is set by. [N]
///
/// "Hardest" is whichever material gives the largest force.   [main]
[[nodiscard]] double work_force(const ToolSetup& setup, const Body& body, double feed_rate);

}  // namespace kerf
