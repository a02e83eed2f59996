// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/made/dimension.h"

namespace kerf::documents {

/// Collects the dimensions of a population. Values are drawn within 2.6 standard deviations of the source, and set
/// within 4.2.
class DimensionTable {
public:
    /// Adds a dimension and sets its bounds.
    /// @param floor   least value that may be drawn or set [SI]
    /// @param digit   to which the bounds of `--set` are rounded [SI]
    Dimension& add(Dimension dimension, double floor, double digit);

    /// Adds a length; its arguments are in millimetres, its own variation is shared along a spine.
    Dimension& length(const char* name, const char* help, double mean_mm, double sd_mm, double loading,
                      Evidence evidence, const char* source, double floor_mm = 0.1);

    /// Adds an angle; its arguments are in degrees, it does not depend on size.
    Dimension& angle(const char* name, const char* help, double mean_deg, double sd_deg, Evidence evidence,
                     const char* source);

    /// Adds an apparent density; its arguments are in kg/m³, it does not depend on size.
    Dimension& density(const char* name, const char* help, double mean, double sd, Evidence evidence,
                       const char* source, double floor);

    std::vector<Dimension> all;
};

/// Returns a value with its unit for messages, rounded to 0.01 mm or 0.0006°.   [any]
[[nodiscard]] std::string dimension_text(double value, const char* unit);

}  // namespace kerf::documents
