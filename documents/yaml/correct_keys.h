// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/yaml/document.h"
#include "documents/yaml/shape.h"

namespace kerf::documents {

/// Reports keys that are misspelt, and gives them in the tree the name that was meant: one mistake then stays one
/// error, and whatever reads the tree goes on with the value. Keys like no other stay for the reader to report. [main]
void correct_keys(Node& document, const Shape& shape, Report& report);

}  // namespace kerf::documents
