// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bone/image/image_file.h"

namespace kerf::bone::header {

/// NRRD's key/value pairs: `Segment0_Name:=femur`.
using Remarks = std::map<std::string, std::string>;

/// Returns the structures of a segmentation by 3D Slicer, from `SegmentN_Name`, `SegmentN_LabelValue` and
/// `SegmentN_Layer`. 3D Slicer 4.10 wrote neither value nor layer: then segment N is every nonzero voxel of layer N.
/// Error: E0636, a structure whose voxels cannot be distinguished; E0622, a key that is not a number.
[[nodiscard]] std::vector<Segment> segments_of(const Remarks& remarks, int layers);

/// Returns the name of a structure as a document writes it under `keep`.
[[nodiscard]] std::string name_to_write(const std::string& name);

/// Returns a list: `bone` (label 3, layer 0), `skin` …; at most twelve, then a count.
[[nodiscard]] std::string list_of(const std::vector<Segment>& segments);

}  // namespace kerf::bone::header
