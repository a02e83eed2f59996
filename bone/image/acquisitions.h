// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bone/image/dicom_slice.h"

namespace kerf {

/// Slices of one pass over the patient. A series may hold several: before and after contrast, two phases, two voltages.
struct Acquisition {
    std::string name;  ///< what a person calls it by: its number, or a letter where it has none of its own
    std::vector<std::size_t> slices;  ///< which of the series
    double low = 0.0, high = 0.0;     ///< [m] along the slices' normal
};

/// Groups slices by acquisition number, place in time, tube voltage, echo and kernel. Where all of these are alike, by
/// the time of acquisition, if at least two slices share each. Pre: at least one slice.   [any] pure.
[[nodiscard]] std::vector<Acquisition> acquisitions_of(const std::vector<DicomSlice>& slices);

/// Whether two of them cover the same part of the patient: then they are two images and not two parts of one.
/// [any] pure.
[[nodiscard]] bool do_overlap(const std::vector<Acquisition>& acquisitions);

}  // namespace kerf
