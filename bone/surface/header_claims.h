// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "bone/surface/read_surface.h"

namespace kerf::bone {

/// Reads frame and unit from a header or remark: `SPACE=RAS` or `SPACE=LPS`, as 3D Slicer writes it, and `UNITS=mm`.
/// Other text has no effect. Returns false with E0654 for another word behind `SPACE=` or `UNITS=`, or for a
/// contradiction.   [any] pure.
[[nodiscard]] bool read_claims(std::string_view text, SurfaceFile& file, SurfaceError& error);

/// Returns the text without a byte order mark. Nothing, with E0643, if it is UTF-16.   [any] pure.
[[nodiscard]] std::optional<std::string_view> utf8_of(std::string_view text, SurfaceError& error);

}  // namespace kerf::bone
