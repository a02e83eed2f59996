// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/image/dicom_file.h"
#include "bone/image/slice_stack.h"
#include "text/source.h"

/// Which of a folder's files are the slices of one volume, in which order, and whether they can be one. Plain functions
/// of headers: nothing here reads a file.
///
///     E0660  no slice in the folder
///     E0661  several series, and none was chosen
///     E0662  no series of that name
///     E0663  slices that differ in size, orientation, spacing or frame of reference
///     E0664  two slices in one place
///     E0665  slices are missing
///     E0666  slices do not lie one behind the other
///     E0667  a slice that cannot be used: its header lacks something, or its pixels are no grey values
///     E0668  a damaged file
///     E0669  too few slices, or too many voxels
///     E0676  several acquisitions of the same part of the patient, and none was chosen
///     E0677  no acquisition of that name
///     W0671  a tilted gantry: the slices are put straight by resampling
///     W0672  uneven distances: resampled
///     W0673  something to be doubted: no CT, lossy compression, a written tilt or distance that the positions do not
///            have, several acquisitions one behind the other
namespace kerf {

/// One volume, ready to be read.
struct DicomSeries {
    std::vector<DicomSlice> slices;  ///< in the order of the stack
    SliceStack stack;
    StackShape shape;
    std::vector<std::string> notes;  ///< what was found, a sentence each; nothing of whose it is
};

/// What is wanted of a folder that leaves a choice.
struct SeriesChoice {
    std::string name;              ///< as E0661 offers it; empty: the only one
    std::string acquisition = {};  ///< as E0676 offers it; empty: the only one
    bool may_resample = false;     ///< across missing slices, or slices that lie beside each other
};

/// Sorts by place along the normal, and checks every distance, one orientation, one frame of reference.
/// Order and names of files count for nothing. `folder` is what messages call the folder.
/// Error: one of the above, and nothing is guessed. Warnings come along with a result.   [main]
[[nodiscard]] std::optional<DicomSeries> series_of(const std::vector<DicomHeader>& headers, const SeriesChoice& choice,
                                                   const std::string& folder, Diagnostics& diagnostics);

}  // namespace kerf
