// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bone/image/image_file.h"

namespace kerf::header {

/// What NRRD calls key/value pairs: `Segment0_Name:=femur`.
using Remarks = std::map<std::string, std::string>;

/// The structures that 3D Slicer writes into a segmentation: of each `SegmentN_Name`, `SegmentN_LabelValue` and
/// `SegmentN_Layer`. 3D Slicer 4.10 wrote neither value nor layer: then segment N is layer N, and all that is not 0 in
/// it. Error: E0636, a structure whose voxels cannot be told from another's; E0622, a key that is no number.
[[nodiscard]] std::vector<Segment> segments_of(const Remarks& remarks, int layers);

/// The name of a structure as a document may name it under `keep`.
[[nodiscard]] std::string name_to_write(const std::string& name);

/// `bone` (label 3, layer 0), `skin` …: at most twelve, then a count.
[[nodiscard]] std::string list_of(const std::vector<Segment>& segments);

}  // namespace kerf::header
