// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/plugin/component_info.h"
#include "documents/yaml/shape.h"

/// The table of documents as JSON Schema (draft-07), for editors that complete and check while somebody writes.
namespace kerf::documents {

/// A schema of documents of this shape. It refuses no document that the reader accepts; what needs more than one map to
/// be judged (names that refer to others, ranges of values with a unit) it leaves to the reader. Ends with a new line.
/// [main]
/// @param catalog   the tools, forces, parameters and drives that an instrument may name
/// @param comment   one line that it carries along
[[nodiscard]] std::string schema_text(const Shape& shape, const ComponentCatalog& catalog, const std::string& comment);

}  // namespace kerf::documents
