// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bone/image/dicom_slice.h"

/// One DICOM file at a time: its header and its voxels.
namespace kerf {

struct DicomHeader {
    enum class Kind {
        other,     ///< no DICOM file
        no_slice,  ///< DICOM without voxels: a directory, a report, a plan
        damaged,   ///< its elements cannot be as they say
        slice,
    };
    Kind kind = Kind::other;
    DicomSlice slice;     ///< of a `slice`
    std::string trouble;  ///< of a `slice` that cannot be used, or of what is damaged: why, in a few words
};

/// Reads all but the voxels. A small file that promises much costs no memory. Never throws.   [main]
[[nodiscard]] DicomHeader read_dicom_header(const std::string& file);

/// The voxels of a slice as `slope × raw + intercept`, row by row; padding as NaN. Empty: they cannot be decoded, and
/// `trouble` says why. Never throws.   [main]
[[nodiscard]] std::vector<float> read_dicom_voxels(const DicomSlice& slice, std::string& trouble);

}  // namespace kerf
