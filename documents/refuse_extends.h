// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/yaml/document.h"
#include "documents/yaml/shape.h"

/// Documents that would build on another file.
namespace kerf::documents {

/// Reports a key such as `extends` and removes it: a document is complete, and what differs from another is a variant
/// or a patch. Returns true if required keys are missing as well: they were meant to come from the other file, so the
/// rest is not worth reading.   [main]
bool refuse_extends(Document& document, const Shape& whole, text::Diagnostics& found);

}  // namespace kerf::documents
