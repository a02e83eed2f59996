// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "bone/surface/read_surface.h"

namespace kerf {

/// Reads what a header or remark says of the coordinates: `SPACE=RAS` or `SPACE=LPS`, as 3D Slicer writes it, and
/// `UNITS=mm`. Other text is no claim. False, with E0654: another word behind `SPACE=` or `UNITS=`, or a second, other
/// one.   [any] pure.
[[nodiscard]] bool read_claims(std::string_view text, SurfaceFile& file, SurfaceError& error);

/// The text without a byte order mark. Empty, with E0643: it is UTF-16.   [any] pure.
[[nodiscard]] std::optional<std::string_view> utf8_of(std::string_view text, SurfaceError& error);

}  // namespace kerf
