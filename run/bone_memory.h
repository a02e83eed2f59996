// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/import/fields_memory.h"
#include "documents/anatomy.h"
#include "documents/procedure.h"
#include "text/source.h"

/// Estimates the memory of a phantom's fields before any is allocated.
namespace kerf::run {

/// Returns the approximate memory of the fields of `phantom` at `spacing` [m], in bytes. It counts the table entry of
/// each brick, and the samples of bricks near a border, estimated from scattered points. The error is a few per cent.
/// Infinite if a grid cannot count the bricks.   [any] pure, takes milliseconds.
[[nodiscard]] double bone_memory(const documents::Anatomy& anatomy, double spacing);

/// Refuses a spacing at which the phantom would need more than `max_bone_memory`, and suggests a coarser one. Bone of
/// a scan or a surface is checked during import (bone/import/make_body.h): its border is unknown before it is read.
/// [main]
void check_bone_memory(const documents::Procedure& procedure, const documents::Anatomy& anatomy,
                       text::Diagnostics& diagnostics);

}  // namespace kerf::run
