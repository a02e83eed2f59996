// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "bone/measure/surface.h"
#include "documents/anatomy.h"
#include "documents/measure_plan.h"

namespace kerf {

/// What measures are made of. Everything must outlive the measuring.
struct MeasuredScene {
    std::span<const Construction> constructions;
    std::span<const Measure> measures{};  ///< that a difference is made of
    const Anatomy* anatomy = nullptr;
    /// Of each body, in the order of bodies; empty: nothing has moved. Landmarks of a fracture's fragment move with it.
    std::span<const Pose> world_from_body;
    const MeasuredSurface* surface = nullptr;  ///< of body 0, in its frame
};

/// Measures the bone. All of it is seen in the frame of body 0: the bone that stays.
///
/// Inputs of the uncertainty are each coordinate of each landmark, within its tolerance, the contacts of tangents, and
/// the walls that an axis passes; of lines and planes through more points than they need also the residual, for each
/// coordinate of these points. They are combined as in bone/measure/propagate.h, so a landmark that is used twice
/// counts once. A plane's normal has no uncertainty, as an anatomy states none.   [worker]
/// @return   a value and its uncertainty, or why there is none
[[nodiscard]] MeasureReading evaluate(const Measure& measure, const MeasuredScene& scene);

}  // namespace kerf
