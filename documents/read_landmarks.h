// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "documents/yaml/read_map.h"

namespace kerf::documents {

/// Reads `landmarks:` into the points, axes, planes and markups of the anatomy.   [main]
void read_landmarks(const Node& node, Anatomy& anatomy, Report& report);

/// Returns the children of a map whose keys are ids that the author chose; none if `node` is null.   [main]
[[nodiscard]] const std::vector<Node>& read_named(const Node* node, const std::string& name, UniqueIds& ids,
                                                  Report& report);

}  // namespace kerf::documents
