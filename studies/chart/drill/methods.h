// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/chart/drill/method.h"
#include "studies/chart/named_setup.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// The drilling plugin's law, which every method that is not a paper's shares.   [main]
/// Error: there is no such plugin, or its parameters have other names.
[[nodiscard]] std::optional<CuttingLaw> shared_law(const Plugins& plugins, std::string& error);

/// Every method that the plugins allow.
///
///     M1   touch by counting, as printed [tsai-2007]
///     M2   the shared law on lips sampled in binary voxels
///     M3   on trilinear density
///     M4   on Kerf's fields: borders within a voxel
///     M5   on shares of tissue, trilinear: elements of mixed material
///     M6   density alone, as printed [dental-implant-2013]
///     M8   the lip integral on Kerf's fields
///     M9   M4 with proxy and virtual coupling: what Kerf does
///     000, 001   [tsai-2007] and [volumetric-drilling] as printed
///
/// @param quick  two steps of each knob   [main]
[[nodiscard]] std::vector<Method> all_methods(const Plugins& plugins, const CuttingLaw& law, bool quick);

}  // namespace kerf::chart
