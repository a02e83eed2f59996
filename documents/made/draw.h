// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "documents/made/dimension.h"
#include "documents/made/people.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the contradiction between the dimensions of a bone; empty: none.
using FindContradiction = std::function<std::string(const DimensionValues&)>;

/// The population that a bone is drawn from.
struct Population {
    std::vector<Dimension> dimensions;  ///< of one sex
    std::vector<std::string> levels{};  ///< of the spine, from T11 to this one; empty: no spine
    Stature stature{};
    FindContradiction find_contradiction;
};

struct DrawnBone {
    DimensionValues values;
    int redraws = 0;              ///< attempts that were not plausible
    std::string contradiction{};  ///< why no plausible bone was found; empty: one was
};

/// Returns the dimensions of one bone. Without a seed these are the means, shifted by the requested stature.
///
///     z = l s + √(1 − l²) e
///
/// z: deviation from the mean; s: size of the person; l: loading; e: own variation, shared with the partner and with
/// the neighbouring levels. e is drawn again until the value lies within its bounds. A bone whose dimensions contradict
/// each other is drawn again with the same s, up to 1000 times. Fixed dimensions are set before.   [any] pure
[[nodiscard]] DrawnBone draw_bone(const Population& population, const MakeRequest& request);

}  // namespace kerf::documents
