// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/anatomy.h"
#include "documents/procedure.h"

/// What a procedure needs of its anatomy. Places of the messages are in the procedure.
namespace kerf::documents {

/// Reports the landmarks, zones and tissues that the procedure needs and this anatomy does not have.   [main]
/// @param is_sound   whether the anatomy has no errors: else a list that is empty is not compared
void check_names(const Procedure& procedure, const Anatomy& anatomy, bool is_sound, text::Diagnostics& diagnostics);

/// Reports all that the procedure needs and this anatomy does not have: names as above, an axis for every step, and the
/// point `midline` when a rehearsal moves towards it. It skips the check of a fitted axis against its step's plane: the
/// position of that axis is not known yet.   [main]
void check_needs(const Procedure& procedure, const Anatomy& anatomy, text::Diagnostics& diagnostics);

/// Reports the steps whose axis leaves their plane or lies next to it (E0507).   [main]
void check_axes_in_planes(const Procedure& procedure, const Anatomy& anatomy, text::Diagnostics& diagnostics);

}  // namespace kerf::documents
