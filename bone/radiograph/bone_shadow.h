// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bone/radiograph/attenuation_image.h"
#include "bone/radiograph/beam.h"

namespace kerf::bone {

/// What bone and soft tissue do to a beam: for each pixel the integral of the attenuation along its ray [–].
///
///     intensity / intensity without a patient = exp(−(bone + soft))         Beer-Lambert, at one energy
struct BoneShadow {
    int columns = 0, rows = 0;
    std::vector<float> bone;  ///< in excess of water; negative behind air
    std::vector<float> soft;  ///< of all tissue as if it were water
    std::string error;        ///< not empty: the beam can give no picture, and there are no pixels
};

/// Projects an image along the rays of a beam, by shear-warp with perspective: slices across the axis nearest to the
/// beam are scaled and added to a picture in a plane between them, and that is projected on the detector.
///
/// Error: as `error_of`; source or detector in the bone; bone behind the source; a source so near that rays graze the
/// slices (the angle to the nearest axis is above 75°).   [worker] pure.
///
/// Source: [lacroute-levoy-1994], without its run-length encoding.
[[nodiscard]] BoneShadow bone_shadow(const AttenuationImage& image, const Beam& beam);

}  // namespace kerf::bone
