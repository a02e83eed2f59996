// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bone/image/dicom_file.h"
#include "bone/image/slice_stack.h"
#include "text/result.h"

/// Selects the slices of one volume from the files of a folder, sorts them, and checks that they form a volume. All are
/// plain functions of headers; nothing here reads a file.
///
///     E0660  no slice in the folder
///     E0661  several series, and none was chosen
///     E0662  no series of that name
///     E0663  slices that differ in size, orientation, spacing or frame of reference
///     E0664  two slices in the same plane
///     E0665  slices are missing
///     E0666  slices that are shifted sideways
///     E0667  a slice that cannot be used: its header is incomplete, or its pixels are not grey values
///     E0668  a damaged file
///     E0669  too few slices, or too many voxels
///     E0676  several acquisitions of the same part of the patient, and none was chosen
///     E0677  no acquisition of that name
///     W0671  a tilted gantry: resampling straightens the slices
///     W0672  uneven distances: resampled
///     W0673  doubtful data: not a CT, lossy compression, a tilt or distance in the header that contradicts the
///            positions, several acquisitions of different parts of the patient
namespace kerf::bone {

/// The slices of one volume, ready to be read.
struct DicomSeries {
    std::vector<DicomSlice> slices;  ///< in the order of the stack
    SliceStack stack;
    StackShape shape;
    std::vector<std::string> notes;  ///< findings, one sentence each; nothing that identifies the patient
};

/// Options for a folder that leaves a choice.
struct SeriesChoice {
    std::string name;              ///< as E0661 lists it; empty: the only one
    std::string acquisition = {};  ///< as E0676 lists it; empty: the only one
    bool may_resample = false;     ///< across missing slices, or slices that are shifted sideways
};

/// Returns the slices sorted by position along their normal, with checked distances, orientation and frame of
/// reference. Order and names of files have no effect. `folder` is the folder's name in messages.
/// Error: one of the codes above; nothing is guessed. A result may have warnings.   [main]
[[nodiscard]] text::Result<DicomSeries> series_of(const std::vector<DicomHeader>& headers, const SeriesChoice& choice,
                                                  const std::string& folder);

}  // namespace kerf::bone
