// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/haptics/scene/simulation.h"
#include "run/view/viewed_run.h"

/// The inside of a tick for a viewer: the law's samples, channels, signals, the coupling and slices of the bone.
namespace kerf::run {

/// Makes inspections between ticks. It reads the simulation, and changes nothing of it.   [main]
class Inspector {
public:
    /// @param spacing  [m] of the cut field
    explicit Inspector(double spacing) : spacing_(spacing) {}

    /// Returns the inspection of the last tick. The law is evaluated once more, to learn where it queries bone.
    /// @param world_from_handle  as the device reported it
    [[nodiscard]] std::shared_ptr<const ViewedInspection> inspect(const Simulation& simulation,
                                                                  const TickResult& result,
                                                                  const Pose& world_from_handle);

private:
    void renew_slices(const Simulation& simulation);

    double spacing_;
    std::uint64_t slices_due_ = 0;  ///< number of ticks from which on the slices are outdated
    std::shared_ptr<const ViewedSlice> along_, across_;
};

/// Returns the channels of the law that the last step of a tick solved, with their forces.   [main]
[[nodiscard]] std::vector<ViewedChannel> viewed_channels(const Simulation& simulation, const TickResult& result);

}  // namespace kerf::run
