// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bone/image/dicom_slice.h"

/// Reads one DICOM file at a time: its header and its voxels.
namespace kerf::bone {

struct DicomHeader {
    enum class Kind {
        other,     ///< not a DICOM file
        no_slice,  ///< DICOM without voxels: a directory, a report, a plan
        damaged,   ///< its elements contradict each other or the file
        slice,
    };
    Kind kind = Kind::other;
    DicomSlice slice;     ///< if `kind` is `slice`
    std::string trouble;  ///< the reason in a few words, of a `slice` that cannot be used or of damage
};

/// Reads everything except the voxels. A small file with large sizes in its header costs no memory. Never throws.
/// [main]
[[nodiscard]] DicomHeader read_dicom_header(const std::string& file);

/// Returns the voxels of a slice as `slope × raw + intercept`, row by row; padding as NaN. Returns nothing if they
/// cannot be decoded; then `trouble` has the reason. Never throws.   [main]
[[nodiscard]] std::vector<float> read_dicom_voxels(const DicomSlice& slice, std::string& trouble);

}  // namespace kerf::bone
