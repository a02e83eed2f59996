// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/yaml/document.h"

namespace kerf::documents {

/// Reports lists of a procedure or an anatomy that are longer than any operation or bone needs. Each of their items is
/// checked against others or made into bone, so the time grows faster than the list. Returns false if there is one: the
/// document is not read further.   [main]
[[nodiscard]] bool are_lists_short(const Node& root, Report& report);

}  // namespace kerf::documents
