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
#include "text/source.h"

namespace kerf {

/// A scan that was opened and judged, but whose voxels were not read yet: a file, or a folder with a DICOM series.
class Scan {
public:
    /// Where its voxels lie once they are straight: what `read` gives.
    [[nodiscard]] const VoxelGrid& grid() const noexcept { return grid_; }

    /// What was found and decided, a sentence each: no names, no paths, nothing of whose it is.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }

    /// Structures that a segmentation names; empty: it has only numbers.
    [[nodiscard]] const std::vector<Segment>& segments() const noexcept { return segments_; }

    /// Whether voxels are computed from those of the scan, which was tilted or uneven.
    [[nodiscard]] bool is_resampled() const noexcept;

    /// Whether `read` costs as much as its range has slices; else a whole file is unpacked each time.
    [[nodiscard]] bool reads_by_slices() const noexcept { return series_.has_value(); }

    /// The voxels of a range of one layer; only what they need is read and kept.
    /// Error (E062x, E067x): nothing is left half-read. Never throws.   [main]
    [[nodiscard]] std::optional<VoxelImage> read(const VoxelRange& range, int layer, const Progress& progress,
                                                 Diagnostics& diagnostics) const;

    /// 64-bit FNV-1a of its files' bytes, slices in the order in which they lie; none if one cannot be read again.
    /// [main]
    [[nodiscard]] std::optional<std::uint64_t> hash() const;

private:
    friend std::optional<Scan> open_scan(const std::string&, const SeriesChoice&, const Progress&, Diagnostics&);

    VoxelGrid grid_;
    std::string source_;
    std::vector<std::string> notes_;
    std::vector<Segment> segments_;
    std::optional<ImageFile> file_;      ///< this,
    std::optional<DicomSeries> series_;  ///< or that
};

/// Opens NIfTI-1, NRRD or MetaImage, or a folder with DICOM files, which is searched with all its subfolders.
///
///     E0670  the folder cannot be read, or holds more than 20000 files
///     E0674  a slice whose voxels cannot be decoded (when reading)
///     E0632  an image that is sheared within its slices
///
/// Error: these, E062x (bone/image/image_file.h) and E066x (bone/image/dicom_series.h). Warnings come
/// along with a result. Never throws.   [main]
[[nodiscard]] std::optional<Scan> open_scan(const std::string& path, const SeriesChoice& choice,
                                            const Progress& progress, Diagnostics& diagnostics);

}  // namespace kerf
