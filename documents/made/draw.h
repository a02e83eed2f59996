// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "documents/made/dimension.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns what makes a bone implausible; empty if nothing does.
using Plausible = std::function<std::string(const DimensionValues&)>;

/// The population that a bone is drawn from.
struct Population {
    std::vector<Dimension> dimensions;  ///< of one sex
    std::vector<std::string> levels{};  ///< of the spine, from the first that is made to this one; empty: no levels
    double mean_stature = 0.0, sd_stature = 0.0;  ///< [m]
    Plausible implausible;                        ///< judges the dimensions together
};

struct DrawnBone {
    DimensionValues values;
    int redraws = 0;              ///< attempts that were not plausible
    std::string contradiction{};  ///< why no plausible bone was found; empty: one was
};

/// Draws the dimensions of a bone; without a seed their means, at the request's stature. Size: one factor s for each
/// person, z = l s + sqrt(1 − l²) e for a dimension whose loading is l; e is drawn until z lies within the dimension's
/// bounds. A bone that is implausible as a whole is drawn again with the same s, up to 1000 times. Fixed dimensions are
/// replaced before the bone is judged.   [any] pure
[[nodiscard]] DrawnBone draw_bone(const Population& population, const MakeRequest& request);

}  // namespace kerf::documents
