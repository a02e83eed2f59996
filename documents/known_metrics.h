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

/// Returns the name of a breach metric within its step: "breach", or "breach-6.5mm" where a step limits several
/// diameters.   [any] pure
/// @param diameter   [m]
[[nodiscard]] std::string breach_name(double diameter, bool is_one_of_several);

}  // namespace kerf::documents
