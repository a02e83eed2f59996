// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/grid/body.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf {

/// A box of bone with its face at z = 0, `thickness` deep and `width` wide, on a grid shifted by part of a voxel.
/// Deeper than `shell` (0: nowhere) its density is `inner` [kg/m³].
struct BoneBlock {
    double thickness = 10e-3;  ///< [m]
    double spacing = 0.25e-3;  ///< [m]
    double density = 1850.0;   ///< [kg/m³]
    double shell = 0.0;        ///< [m]
    double inner = 0.0;        ///< [kg/m³]
    double width = 10e-3;      ///< [m]
};
/// [main]
[[nodiscard]] Body make(const BoneBlock& block);

}  // namespace kerf
