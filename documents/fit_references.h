// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/anatomy.h"
#include "documents/yaml/document.h"

namespace kerf::documents {

/// Reports fits that refer to what cannot be known before them (E0618). A neck needs a point with a sphere; condyles
/// need an axis that is not fitted to condyles, so that no fits form a circle; and the bone must not be chosen by a
/// point that is fitted from it. An axis may still come from a file of markups: that is left to import.   [main]
void check_fit_references(const Node& root, const Anatomy& anatomy, Report& report);

}  // namespace kerf::documents
