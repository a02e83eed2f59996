// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/grid/box.h"
#include "documents/procedure.h"
#include "documents/station.h"
#include "kerf/math.hpp"
#include "run/scene.h"

/// Fits the motion of an operation into the workspace of a device.
namespace kerf::run {

struct WorkspaceFit {
    double scale = 1.0;  ///< [–] motion of the tool per motion of the handle
    /// [m] by which the handle would leave the workspace: below its smallest and above its largest coordinates. 0: it
    /// stays inside.
    Vec3 below{}, above{};

    [[nodiscard]] bool fits() const noexcept { return below == Vec3{} && above == Vec3{}; }
};

/// Returns the smallest scale with which a motion stays in a workspace, from `documents::min_scale` to 1. A larger one
/// would make the device stiffer than it can be: the motion then does not fit.   [any] pure
/// @param workspace  that the handle reaches, device axes [m]
/// @param handle     its position at the start, device axes [m]
/// @param motion     of the tool from the start, device axes [m]; contains 0
[[nodiscard]] WorkspaceFit fit_into(const Box& workspace, Vec3 handle, const Box& motion) noexcept;

/// Returns the box of the path of the hand's grip in a rehearsal, from its start, in the axes of a device, with 20 mm
/// of room on all sides [assumed].   [any] pure
[[nodiscard]] Box motion_of(const documents::Rehearsal& rehearsal, const Scene& scene,
                            const documents::DeviceStation& station);

}  // namespace kerf::run
