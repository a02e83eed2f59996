// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/report/import_report.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"
#include "text/result.h"

/// An anatomy without a procedure.
namespace kerf::run {

struct LoneAnatomy {
    documents::Anatomy anatomy;
    Body body;
    bone::ImportReport import;
    double spacing = 0.0;  ///< [m] of the body's samples
};

/// Reads an anatomy and its data files, and makes its bone, at a coarser spacing if the bone is too large for a fine
/// one. Error: all mistakes of the anatomy.   [main]
[[nodiscard]] text::Result<LoneAnatomy> make_lone_anatomy(const std::string& file,
                                                          const bone::ImportOptions& options = {});

}  // namespace kerf::run
