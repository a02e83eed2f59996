// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "core/field/grid/body.h"
#include "core/haptics/loop/haptic_loop.h"

namespace kerf {

/// A law in infinite bone, with all edges engaged and the motor at its speed.   [main]
class EndlessBoneLaw {
public:
    /// Pre: `setup` outlives this object. `tissues`: the number of tissues of the body.
    EndlessBoneLaw(const ToolSetup& setup, std::size_t tissues);
    ~EndlessBoneLaw();
    EndlessBoneLaw(const EndlessBoneLaw&) = delete;
    EndlessBoneLaw& operator=(const EndlessBoneLaw&) = delete;

    /// Returns the force of the law's channels against a steady feed at `feed_rate` [m/s], in a material of `density`
    /// [kg/m³] [N]. Returns 0 if the tool has no valid outline or the law fails.
    [[nodiscard]] double force(std::size_t material, double density, double feed_rate) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns the largest `EndlessBoneLaw::force` over the body's materials at a steady `feed_rate` [m/s] [N]. The
/// device's force scale is derived from it.   [main]
[[nodiscard]] double work_force(const ToolSetup& setup, const Body& body, double feed_rate);

}  // namespace kerf
