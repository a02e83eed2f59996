// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plugin/component_info.h"
#include "documents/procedure.h"
#include "documents/yaml/document.h"

namespace kerf::documents {

/// Reads one instrument: its tool, force and strategy, with the defaults of their plugins.   [main]
[[nodiscard]] Instrument read_instrument(const Node& node, const ComponentCatalog& catalog, Report& report);

/// Reads the drives that a waypoint sets, of an instrument that has been read.   [main]
[[nodiscard]] std::vector<HandInput> read_inputs(const Node& node, const Instrument& instrument,
                                                 const ComponentCatalog& catalog, Report& report);

/// Returns the force law of an instrument; null if it is unknown.   [main]
[[nodiscard]] const ComponentInfo* law_of(const Instrument& instrument, const ComponentCatalog& catalog);

/// Returns the tool of an instrument; null if it is unknown.   [main]
[[nodiscard]] const ComponentInfo* tool_of(const Instrument& instrument, const ComponentCatalog& catalog);

}  // namespace kerf::documents
