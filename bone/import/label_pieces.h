// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/import/bone_mask.h"
#include "documents/anatomy.h"
#include "text/result.h"

namespace kerf::bone {

/// Warns (W0679) of more pieces of bone than labels are kept. Pieces that reach the end of the region do not count:
/// they may be connected beyond it. Pre: `mask` is the bone in the end.   [main]
void check_label_pieces(const BoneMask& mask, const documents::Anatomy& anatomy, text::Diagnostics& diagnostics);

}  // namespace kerf::bone
