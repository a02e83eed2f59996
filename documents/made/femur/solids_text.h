// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/made/anatomy_text.h"

namespace kerf::documents {

/// Returns solids in one line; lengths in millimetres.   [any]
[[nodiscard]] std::string tube_text(Vec3 from, Vec3 to, double radius);
[[nodiscard]] std::string elliptic_tube_text(Vec3 from, Vec3 to, double width, double height, const std::string& up);
[[nodiscard]] std::string sphere_text(Vec3 centre, double radius);

/// Returns a part of `phantom.parts` whose solid takes one line.   [any]
[[nodiscard]] std::string solid_part(const char* id, const std::string& solid, const WrittenJoint& joint);

/// Returns an axis of `landmarks.axes`.   [any]
[[nodiscard]] std::string axis_text(const char* id, Vec3 from, Vec3 to, double tolerance);

}  // namespace kerf::documents
