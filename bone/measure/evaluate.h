// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "bone/measure/surface.h"
#include "documents/anatomy.h"
#include "documents/measure_plan.h"

namespace kerf::bone {

/// Inputs of measures. All must outlive the measurement.
struct MeasuredScene {
    std::span<const documents::Construction> constructions;
    std::span<const documents::Measure> measures{};  ///< operands of differences
    const documents::Anatomy* anatomy = nullptr;
    /// Pose of each body, in the order of bodies; empty: nothing has moved. Landmarks of a fragment move with the
    /// fragment.
    std::span<const Pose> world_from_body;
    const MeasuredSurface* surface = nullptr;  ///< surface of body 0, in its frame
};

/// Returns the measure of the present bone, in the frame of body 0, the bone that stays.
///
/// Inputs of the uncertainty are the coordinates of all landmarks within their tolerances, the contacts of tangents,
/// and the walls that an axis passes. Lines and planes through more points than they need add the residual, for each
/// coordinate of these points. The inputs are combined as in bone/measure/propagate.h, so a landmark that is used twice
/// counts once. A plane's normal has no uncertainty, as an anatomy states none.   [worker]
/// @return a value and its uncertainty, or the reason why there is none
[[nodiscard]] documents::MeasureReading evaluate(const documents::Measure& measure, const MeasuredScene& scene);

}  // namespace kerf::bone
