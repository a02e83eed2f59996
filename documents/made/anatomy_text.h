// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kerf/math.hpp"

/// Writes anatomies as YAML that people read and edit. Lengths in millimetres.
namespace kerf::documents {

/// Returns a number with at most this many decimals, or two, without trailing zeros, in any locale.   [any]
[[nodiscard]] std::string with_decimals(double value, std::size_t digits);
[[nodiscard]] std::string rounded_text(double value);

/// Returns three numbers without a unit; those of a direction to four decimals.   [any]
[[nodiscard]] std::string vector_text(Vec3 v);
[[nodiscard]] std::string direction_text(Vec3 v);

/// One section of a loft [mm].
struct WrittenSection {
    Vec3 at{};
    double width = 0.0, height = 0.0;
    double exponent = 2.0, taper = 0.0;
    double turn = 0.0;  ///< [deg]
};

/// A loft [mm].
struct WrittenLoft {
    Vec3 up{0, 0, 1};
    double rim = 0.0;
    std::vector<WrittenSection> sections{};
};

/// How a part joins the parts before it.
struct WrittenJoint {
    double blend = 0.0;  ///< [mm]
    bool mirror = false, subtract = false;
    std::string source{};  ///< empty: none
};

/// Returns a part of `phantom.parts`, indented.   [any]
[[nodiscard]] std::string loft_part(const std::string& id, const WrittenLoft& loft, const WrittenJoint& joint);

/// Returns solids in one line; lengths in millimetres.   [any]
[[nodiscard]] std::string tube_text(Vec3 from, Vec3 to, double radius);
[[nodiscard]] std::string elliptic_tube_text(Vec3 from, Vec3 to, double width, double height, const std::string& up);
[[nodiscard]] std::string sphere_text(Vec3 centre, double radius);

/// Returns a part of `phantom.parts` whose solid takes one line.   [any]
[[nodiscard]] std::string solid_part(const char* id, const std::string& solid, const WrittenJoint& joint);

/// Returns an axis of `landmarks.axes`.   [any]
[[nodiscard]] std::string axis_text(const char* id, Vec3 from, Vec3 to, double tolerance);

/// Returns `loft:` as an item of a zone's list.   [any]
[[nodiscard]] std::string loft_item(const WrittenLoft& loft, int indent);

/// Returns a text in lines of at most 120 characters that begin with `margin`.   [any]
[[nodiscard]] std::string wrapped(const std::string& text, const std::string& margin);

/// Returns a text folded to lines of at most 120 characters behind `>-`, or as one line if it fits.   [any]
[[nodiscard]] std::string folded(const std::string& key, const std::string& text, int indent);

}  // namespace kerf::documents
