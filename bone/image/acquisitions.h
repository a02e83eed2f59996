// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bone/image/dicom_slice.h"

namespace kerf::bone {

/// Slices of one pass over the patient. A series may have several: before and after contrast, two phases, two voltages.
struct Acquisition {
    std::string name;  ///< for people: the acquisition number, or a letter if several groups have the same number
    std::vector<std::size_t> slices;  ///< indices of the slices in the series
    double low = 0.0, high = 0.0;     ///< [m] along the slices' normal
};

/// Groups slices by acquisition number, temporal position, tube voltage, echo and kernel. If all of these are equal,
/// groups by the time of acquisition, provided that each time has at least two slices. Pre: at least one slice.   [any]
/// pure.
[[nodiscard]] std::vector<Acquisition> acquisitions_of(const std::vector<DicomSlice>& slices);

/// Returns whether two acquisitions cover the same part of the patient. Then they are two images, not two parts of one.
/// [any] pure.
[[nodiscard]] bool do_overlap(const std::vector<Acquisition>& acquisitions);

}  // namespace kerf::bone
