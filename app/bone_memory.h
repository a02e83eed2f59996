// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/procedure/anatomy.h"
#include "core/procedure/procedure.h"
#include "core/procedure/source.h"

/// How much memory a phantom's fields will take, before any of it is asked for.
namespace kerf {

/// The most that the bone of one run may take [bytes].
inline constexpr double most_bone_memory = 4.0 * 1024 * 1024 * 1024;

/// About what the fields of `phantom` take at `spacing` [m], in bytes: each brick's entry in the table, and the samples
/// of the bricks near a border, whose share is found by asking at scattered points. A few per cent off. Infinite when
/// the bricks are more than a grid can count.   [any] pure, takes milliseconds.
[[nodiscard]] double bone_memory(const Anatomy& anatomy, double spacing);

/// Refuses a spacing at which the phantom would take more than `most_bone_memory`, and says which one would do. A scan
/// is left to what makes the bone: its border is not known before it is read.   [main]
void check_bone_memory(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics);

}  // namespace kerf
