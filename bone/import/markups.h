// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "documents/anatomy.h"
#include "text/source.h"

/// Reads landmarks from 3D Slicer.
///
///     E0680  the file is neither .mrk.json nor .fcsv, or is malformed
///     E0681  the frame or unit of its coordinates is missing
///     E0682  a markup that is not points, a line or a plane, or has no position
///     E0683  a name that is not an id, or exists already
namespace kerf::bone {

/// Adds the landmarks of the files under `anatomy.markups`: points by their labels; a line as an axis from its first
/// point to its second; a plane by its normal. A line or plane has its own name or, without one, the label of its first
/// point. The frame comes from the file and is never guessed; RAS becomes LPS. Returns the files' hashes. Error: E0101
/// … E0103 (the file cannot be read) and the above; then nothing of that file is added. Never throws.   [main]
std::vector<std::uint64_t> add_markups(documents::Anatomy& anatomy, text::Diagnostics& diagnostics);

}  // namespace kerf::bone
