// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/lone_anatomy.h"

namespace kerf::app {

/// Returns the text that `kerf anatomy check` prints for an anatomy without errors: the notes of import, the positions
/// of landmarks and zones relative to the bone, and the uncertainty of its border.   [main]
[[nodiscard]] std::string anatomy_text(const documents::Anatomy& anatomy, const Body& body,
                                       const bone::ImportReport& import);

/// The same for an anatomy without a procedure, with the spacing of its bone.   [main]
[[nodiscard]] std::string anatomy_text(const run::LoneAnatomy& alone);

}  // namespace kerf::app
