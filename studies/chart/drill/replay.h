// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "studies/chart/drill/method.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// The same physics on a finer grid: the reference where there is no exact one.
struct Replayed {
    std::vector<double> axial;  ///< [N] bone on tool along +z of the tool, tick by tick, on the finest grid
    double volume = 0.0;        ///< [m³] Richardson-extrapolated from two grids
};

/// Moves a tool as another one moved, its law evaluated at that motion, on grids of 0.2 and 0.1 mm with 62 points per
/// lip.
/// @param felt  of a run of the solved `method`   [main]
[[nodiscard]] Replayed replay(const Method& method, const Scene& scene, const std::vector<Felt>& felt);

}  // namespace kerf::chart
