// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bone/image/dicom_slice.h"

namespace kerf::bone {

/// Returns whether pixels of this transfer syntax can be unpacked: run length, JPEG, JPEG-LS, JPEG 2000.   [any]
[[nodiscard]] bool can_unpack(const std::string& encoding);

/// Unpacks the pixels of a slice: rows × columns × bits_allocated / 8 bytes, least significant first. `fragments` are
/// the file's, without the table. Returns nothing if they are damaged. GDCM's codecs run in a separate process with
/// limits of time and memory, so a crash there does no harm here. Only this unit includes GDCM.   [main]
[[nodiscard]] std::vector<char> unpacked_pixels(const DicomSlice& slice, const std::vector<std::string>& fragments);

}  // namespace kerf::bone
