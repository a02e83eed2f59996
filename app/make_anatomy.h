// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/options.h"
#include "documents/made/make_bone.h"
#include "text/result.h"

namespace kerf::app {

/// Makes the bone that the options of `kerf anatomy make` describe. Error: they describe no bone that can be made.
/// [main]
[[nodiscard]] text::Result<documents::MadeBone> make_bone_of(const AnatomyOptions& options);

/// Returns a made bone's dimensions, requested and measured, and how often it was drawn again.   [any]
[[nodiscard]] std::string made_bone_text(const documents::MadeBone& bone);

/// Returns the dimensions of "vertebra" or "vertebra/L5". Empty if `wanted` is no kind of bone that can be made, or if
/// its level is unknown; then `error` lists the levels.   [main]
[[nodiscard]] std::string description_of_bone(const std::string& wanted, std::string& error);

}  // namespace kerf::app
