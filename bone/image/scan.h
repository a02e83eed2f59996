// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bone/image/dicom_series.h"
#include "bone/image/image_file.h"
#include "bone/image/voxel_image.h"
#include "bone/report/import_report.h"
#include "text/result.h"

namespace kerf::bone {

/// A scan that was opened and checked, but whose voxels are not read yet: a file, or a folder with a DICOM series.
class Scan {
public:
    /// Returns the grid of the straightened voxels that `read` returns.
    [[nodiscard]] const VoxelGrid& grid() const noexcept { return grid_; }

    /// Returns findings and decisions, one sentence each, without names, paths or anything that identifies the patient.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }

    /// Returns the named structures of a segmentation; empty if it has only numbers.
    [[nodiscard]] const std::vector<Segment>& segments() const noexcept { return segments_; }

    /// Returns whether voxels are resampled, because the scan is tilted or uneven.
    [[nodiscard]] bool is_resampled() const noexcept;

    /// Returns whether the cost of `read` grows with the slices of its range. Otherwise each call unpacks a whole file.
    [[nodiscard]] bool reads_by_slices() const noexcept { return series_.has_value(); }

    /// Returns the voxels of a range of one layer. Reads and stores only the data that they need. Error (E062x, E067x):
    /// returns nothing. Never throws.   [main]
    [[nodiscard]] text::Result<VoxelImage> read(const VoxelRange& range, int layer, const Progress& progress) const;

    /// Returns the 64-bit FNV-1a of its files' bytes, slices in the order of the stack; nothing if a file cannot be
    /// read.   [main]
    [[nodiscard]] std::optional<std::uint64_t> hash() const;

private:
    friend text::Result<Scan> open_scan(const std::string&, const SeriesChoice&, const Progress&);

    VoxelGrid grid_;
    std::string source_;
    std::vector<std::string> notes_;
    std::vector<Segment> segments_;
    std::optional<ImageFile> file_;      ///< either this
    std::optional<DicomSeries> series_;  ///< or this
};

/// Opens NIfTI-1, NRRD or MetaImage, or a folder with DICOM files, including its subfolders.
///
///     E0670  the folder cannot be read, or has more than 20000 files
///     E0674  a slice whose voxels cannot be decoded (when reading)
///     E0632  an image that is sheared within its slices
///
/// Error: these, E062x (bone/image/image_file.h) and E066x (bone/image/dicom_series.h). A result may have warnings.
/// Never throws.   [main]
[[nodiscard]] text::Result<Scan> open_scan(const std::string& path, const SeriesChoice& choice,
                                           const Progress& progress);

}  // namespace kerf::bone
