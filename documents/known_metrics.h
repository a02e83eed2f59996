// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plugin/component_info.h"
#include "documents/procedure.h"
#include "text/quantity.h"

namespace kerf::documents {

/// A metric that results can have.
struct KnownMetric {
    std::string id;    ///< "insert.entry-offset"
    std::string step;  ///< id; empty: of the whole run
    text::QuantityNeed need;
};
/// Returns the metrics that the results of a procedure can have. Which of them a run has depends on what its hand
/// does.   [any]
[[nodiscard]] std::vector<KnownMetric> metrics_of(const Procedure& procedure, const ComponentCatalog& catalog);

}  // namespace kerf::documents
