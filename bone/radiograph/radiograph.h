// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bone/radiograph/attenuation_image.h"
#include "bone/radiograph/beam.h"
#include "bone/radiograph/metal_shadow.h"

namespace kerf::bone {

/// A fluoroscopic picture: rows from the top, 0 black. Bone and metal are dark. Outside the circle of the collimator it
/// is black.
struct Radiograph {
    int columns = 0, rows = 0;
    std::vector<std::uint8_t> grey;
    std::string error;  ///< not empty: the beam can give no picture, and there are no pixels
};

/// How the picture is developed. All figures are [assumed]; those of a picture of 512 columns.
struct Development {
    double noise = 0.02;      ///< [–] standard deviation of the logarithm at the median of the bone
    double sharpening = 0.5;  ///< [–] of the local mean that is taken away
    int neighbourhood = 49;   ///< [pixels] edge of the square of that mean
    /// [–] of white: the 98th and 2nd percentile of the bone. Values beyond them are compressed, as a detector's do.
    double darkest = 0.16, brightest = 0.66;
    std::uint64_t shot = 0;  ///< number of the picture: another number, other noise
};

/// Takes a picture of bone and metal. The logarithm of the intensity is blurred as by a detector, sharpened, and scaled
/// to the bone in the picture; noise is drawn from pixel and shot. Then metal is multiplied in, as sharpening would
/// give it a halo. The same arguments give the same bytes.
///
/// Leaves out scatter, beam hardening and the distortion of an image intensifier.   [worker] pure.
/// Error: as `bone_shadow`.
[[nodiscard]] Radiograph radiograph(const AttenuationImage& image, const Beam& beam, std::span<const MetalShape> metal,
                                    const Development& development = {});

}  // namespace kerf::bone
