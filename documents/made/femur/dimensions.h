// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/made/draw.h"
#include "documents/made/request.h"

namespace kerf::documents {

/// Returns the dimensions of a femur's end in adults of one sex; of both together if it is unsaid. Age and osteoporosis
/// set the canal, the cortex and the density.   Pre: the level is one of the kind `femur`.   [main]
[[nodiscard]] Population femur_population(const MakeRequest& request);

/// Returns the distance from the centre of the head to the axis of the shaft, along the neck [m].
[[nodiscard]] double neck_length(const DimensionValues& femur);

/// Returns how high the tip of the greater trochanter lies over the point where the axes of neck and shaft meet [m].
[[nodiscard]] double greater_trochanter_height(const DimensionValues& femur);

/// Returns the height of the tip of the lesser trochanter in the same frame, negative below [m].
[[nodiscard]] double lesser_trochanter_height(const DimensionValues& femur);

/// Returns the width of the lower end level with the cut of an amputation [m]; assumed.
[[nodiscard]] double distal_cut_width(const DimensionValues& femur);

/// Where the tips of both trochanters lie, in widths of the shaft: x lateral, y posterior [–].
struct TrochanterTip {
    double x = 0.0, y = 0.0;
};
inline constexpr TrochanterTip greater_tip{0.328, 0.255}, lesser_tip{-0.762, 0.677};

}  // namespace kerf::documents
