// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/anatomy.h"
#include "documents/procedure.h"
#include "text/source.h"

/// The data files that documents name.
namespace kerf::run {

/// Reports files of the anatomy that do not exist. Import checks the contents.   [main]
void check_data_files(const documents::Anatomy& anatomy, text::Diagnostics& diagnostics);

/// Reports files of a procedure's implants that do not exist.   [main]
void check_implant_files(const documents::Procedure& procedure, text::Diagnostics& diagnostics);

}  // namespace kerf::run
