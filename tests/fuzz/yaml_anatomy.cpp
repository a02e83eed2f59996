// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "documents/read_anatomy.h"
#include "tests/fuzz/diagnosed.h"

bool kerf::fuzz::reads(std::string_view input) {
    text::Diagnostics diagnostics;
    const auto anatomy = documents::read_anatomy_text("a.yaml", std::string(input)).take(diagnostics);
    require_reason(anatomy.has_value(), diagnostics);
    if (!anatomy) return false;
    for (const documents::LandmarkPoint& point : anatomy->points)
        require(is_finite(point.at), "landmarks lie somewhere");
    for (const documents::Tissue& tissue : anatomy->tissues) require(tissue.density > 0.0, "tissues weigh something");
    return true;
}
