// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/measure/measured.h"
#include "bone/measure/surface.h"

/// The two angles that judge the operation on a mandible's angle [rad].   [worker]
namespace kerf::bone {

/// A position with its accuracy: each coordinate lies within ± `tolerance` [m] with equal probability.
struct KnownPoint {
    Vec3 at{};
    double tolerance = 0.0;
};

/// The landmarks of one side.
struct MandibleSide {
    KnownPoint condylion{};  ///< the top of the condyle, or articulare on the back of its neck
    KnownPoint gonion{};     ///< the corner between ramus and body
    KnownPoint menton{};     ///< the lowest point of the chin
    double within = 15e-3;   ///< [m] largest distance of a border from the straight line between its two landmarks
};
/// The sagittal plane. Its normal points to the patient's left.
struct SagittalView {
    Vec3 normal{1, 0, 0};  ///< unit
    Vec3 posterior{0, 1, 0}, inferior{0, 0, -1};
};

/// Returns the gonial angle of one side: between the tangent of the ramus's posterior border and that of the body's
/// lower border, in the sagittal projection of this side. About 2.1 rad, which is 120°.
///
/// The posterior tangent touches the surface near the line from gonion to condylion, the lower one near the line from
/// gonion to menton; both as in bone/measure/tangent.h. Bone of the other side is not near these lines. The uncertainty
/// follows from the three landmarks' coordinates and from each contact across its tangent. Nothing if a border has no
/// bone.
///
/// Source: the construction of a lateral cephalogram [putri-zen]: the tangent of the ramus's posterior border, and
/// Downs's mandibular plane, which is also a tangent. [mandibular-angle] reports this angle without its construction.
[[nodiscard]] std::optional<Measured> gonial_angle(const MeasuredSurface& surface, const MandibleSide& side,
                                                   const SagittalView& view = {});

/// Returns the mandibular plane angle of one side: between the tangent of the body's lower border, from gonion to
/// menton, and a reference plane as it appears in the sagittal projection. About 0.45 rad, which is 25°.
///
/// `reference` is the Frankfort horizontal through porion and orbitale if these are known, or any other plane. The
/// caller adds its uncertainty.
[[nodiscard]] std::optional<Measured> mandibular_plane_angle(const MeasuredSurface& surface, const MandibleSide& side,
                                                             const Plane& reference, const SagittalView& view = {});

}  // namespace kerf::bone
