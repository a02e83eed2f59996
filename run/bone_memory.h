// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/import/fields_memory.h"
#include "documents/anatomy.h"
#include "documents/procedure.h"
#include "text/source.h"

/// How much memory a phantom's fields will take, before any of it is asked for.
namespace kerf {

/// About what the fields of `phantom` take at `spacing` [m], in bytes: each brick's entry in the table, and the samples
/// of the bricks near a border, whose share is found by asking at scattered points. A few per cent off. Infinite when
/// the bricks are more than a grid can count.   [any] pure, takes milliseconds.
[[nodiscard]] double bone_memory(const Anatomy& anatomy, double spacing);

/// Refuses a spacing at which the phantom would take more than `most_bone_memory`, and says which one would do. Bone
/// of a scan or a surface is left to what makes it (bone/import/make_body.h): its border is not known before it is
/// read.   [main]
void check_bone_memory(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics);

}  // namespace kerf
