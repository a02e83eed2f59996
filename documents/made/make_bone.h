// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/made/bone_kind.h"
#include "documents/made/draw.h"
#include "documents/made/measured_dimension.h"
#include "documents/made/request.h"

/// Makes bones from published dimensions of people.
namespace kerf::documents {

struct MadeBone {
    std::string name;     ///< "vertebra-l3-seed-7"
    std::string title;    ///< for people
    std::string text;     ///< `kind: Anatomy`, to read and to edit
    MakeRequest request;  ///< with the sex that was drawn
    Population population;
    DrawnBone drawn;
    std::vector<MeasuredDimension> measured;
};

/// Returns the population that a request draws from. With a seed and an unsaid sex, `request` receives the one that is
/// drawn.   Pre: kind and level exist.   [main]
[[nodiscard]] Population population_of(MakeRequest& request);

/// Draws a bone and writes its anatomy. `drawn.contradiction` states why there is none; then `text` is empty.
/// Pre: kind and level exist, fixed dimensions lie within their bounds.   [main]
[[nodiscard]] MadeBone make_bone(const MakeRequest& request);

/// Returns a table of the dimensions, requested and measured, with their sources. Every line begins with `margin`.
/// [any]
[[nodiscard]] std::string table_of_dimensions(const MadeBone& bone, const std::string& margin);

/// Returns the dimensions of a kind of bone for people: mean, SD, bounds and source.   Pre: as above.   [main]
[[nodiscard]] std::string described_dimensions(const MakeRequest& request);

}  // namespace kerf::documents
