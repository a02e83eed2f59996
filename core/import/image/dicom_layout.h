// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace kerf {

/// How a DICOM file's elements lie in it. Nothing is kept of what they say.
struct DicomLayout {
    bool is_dicom = false;         ///< the word DICM stands where it should
    std::string fault;             ///< why the elements cannot be as they say; empty: they can
    std::string encoding;          ///< UID of the transfer syntax
    bool has_voxels = false;       ///< an element with pixel data
    bool is_encapsulated = false;  ///< they are compressed, in fragments
    std::uint64_t voxel_bytes = 0; ///< [bytes] of the pixel data, or of all fragments
};

/// Walks from element to element, up to the pixel data and over them. A length that goes beyond the file or its
/// own sequence is a fault: whoever believed it would take memory for bytes that are not there. Never throws.   [main]
[[nodiscard]] DicomLayout dicom_layout(const std::string& file);

}  // namespace kerf
