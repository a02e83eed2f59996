// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "documents/anatomy.h"
#include "text/source.h"

/// Landmarks that 3D Slicer wrote.
///
///     E0680  the file is neither .mrk.json nor .fcsv, or not in their form
///     E0681  it does not say in which frame or unit its coordinates are
///     E0682  a markup that is neither points, a line nor a plane, or lacks a place
///     E0683  a name that is no id, or is there already
namespace kerf {

/// Adds what the files under `anatomy.markups` hold to its points, axes and planes: points by their labels; a line as
/// an axis from its first point to its second; a plane by its normal. A line or plane is called by its name or, without
/// one, by the label of its first point. The frame is the file's own, never guessed: RAS becomes LPS. Gives the files'
/// hashes. Error: E0101 … E0103 (the file cannot be read) and the above; then nothing of that file is added. Never
/// throws.   [main]
std::vector<std::uint64_t> add_markups(Anatomy& anatomy, Diagnostics& diagnostics);

}  // namespace kerf
