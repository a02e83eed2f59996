// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/image/dicom_elements.h"
#include "kerf/math.hpp"

namespace kerf {

/// What one DICOM file says of its slice, as far as place and values need it, and nothing of whose it is. Frame: LPS,
/// metres.
struct DicomSlice {
    std::string file;                ///< to read its voxels from; never shown or written
    std::string series;              ///< UID, to tell one series from another; never shown or written
    std::string frame_of_reference;  ///< UID, the same; empty if not said
    int series_number = 0;           ///< 0: none
    int instance = 0;
    /// What tells one pass over the patient from another in the same series. Only compared and, where they are small
    /// numbers, shown.
    int acquisition = 0;        ///< number; 0: none
    std::string pass;           ///< place in time, tube voltage, echo and reconstruction kernel
    std::string acquired_at;    ///< date and time; never shown or written
    std::string modality;       ///< "CT" …; at most two letters, else empty
    bool is_localizer = false;  ///< an overview, not a slice of a volume
    std::string values;         ///< what the rescaled values are: "HU" …; empty if not said
    bool is_lossy = false;      ///< its values were changed by compression

    int columns = 0, rows = 0;
    double between_columns = 0.0, between_rows = 0.0;  ///< [m] centre to centre: along a row, down a column
    Vec3 along_row{}, down_column{};                   ///< unit; as the column index grows, as the row index grows
    Vec3 origin{};                                     ///< [m] centre of the first voxel
    std::optional<double> tilt;                        ///< [rad] of the gantry, as written
    std::optional<double> between_slices;              ///< [m] centre to centre, as written

    int bits_allocated = 16, bits_stored = 16, high_bit = 15;
    bool is_signed = false;
    /// Raw values of pixels that were never measured, both ends included. One value: both are the same.
    struct Padding {
        int least = 0, most = 0;
    };
    std::optional<Padding> padding;
    double slope = 1.0, intercept = 0.0;  ///< value = slope × raw + intercept

    std::string encoding;  ///< UID of the transfer syntax
    bool is_big_endian = false;
    bool is_compressed = false;                ///< in fragments, of which the first is a table
    std::vector<DicomElements::Piece> voxels;  ///< where they lie in the file

    [[nodiscard]] Vec3 normal() const noexcept { return cross(along_row, down_column); }
};

}  // namespace kerf
