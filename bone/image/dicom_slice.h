// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/image/dicom_elements.h"
#include "kerf/math.hpp"

namespace kerf::bone {

/// Header of one DICOM slice: geometry and values. It keeps nothing that identifies the patient, except for fields that
/// are marked "never shown or written". Frame: LPS, metres.
struct DicomSlice {
    std::string file;                ///< to read its voxels from; never shown or written
    std::string series;              ///< UID that separates series; never shown or written
    std::string frame_of_reference;  ///< UID; never shown or written; empty if missing
    int series_number = 0;           ///< 0: none
    int instance = 0;
    /// Fields that separate passes over the patient in one series. They are only compared; small numbers may be shown.
    int acquisition = 0;        ///< number; 0: none
    std::string pass;           ///< temporal position, tube voltage, echo and reconstruction kernel
    std::string acquired_at;    ///< date and time; never shown or written
    std::string modality;       ///< "CT" …; at most two letters, else empty
    bool is_localizer = false;  ///< an overview, not a slice of a volume
    std::string values;         ///< type of the rescaled values: "HU" …; empty if missing
    bool is_lossy = false;      ///< compression changed its values

    int columns = 0, rows = 0;
    double between_columns = 0.0, between_rows = 0.0;  ///< [m] centre to centre: along a row, down a column
    Vec3 along_row{}, down_column{};                   ///< unit; as the column index grows, as the row index grows
    Vec3 origin{};                                     ///< [m] centre of the first voxel
    std::optional<double> tilt;                        ///< [rad] of the gantry, as written
    std::optional<double> between_slices;              ///< [m] centre to centre, as written

    int bits_allocated = 16, bits_stored = 16, high_bit = 15;
    bool is_signed = false;
    /// Range of raw values of pixels that were never measured, both ends included. Both may be equal.
    struct Padding {
        int low = 0, high = 0;
    };
    std::optional<Padding> padding;
    double slope = 1.0, intercept = 0.0;  ///< value = slope × raw + intercept

    std::string encoding;  ///< UID of the transfer syntax
    bool is_big_endian = false;
    bool is_compressed = false;                ///< in fragments, of which the first is a table
    std::vector<DicomElements::Piece> voxels;  ///< their positions in the file

    [[nodiscard]] Vec3 normal() const noexcept { return cross(along_row, down_column); }
};

}  // namespace kerf::bone
