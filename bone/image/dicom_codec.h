// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bone/image/dicom_slice.h"

namespace kerf {

/// Whether pixels of this transfer syntax can be unpacked: run lengths, JPEG, JPEG-LS, JPEG 2000.   [any]
[[nodiscard]] bool can_unpack(const std::string& encoding);

/// Unpacks the pixels of a slice: rows × columns × bits_allocated / 8 bytes, least significant first. `fragments` are
/// the file's, without the table. Empty: they are damaged. The codecs (GDCM's) run in a process of their own, which may
/// crash, take too long or want too much memory without harm to this one. What reads them is seen by one unit only.
/// [main]
[[nodiscard]] std::vector<char> unpacked_pixels(const DicomSlice& slice, const std::vector<std::string>& fragments);

}  // namespace kerf
