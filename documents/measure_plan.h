// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kerf/math.hpp"

/// What a procedure measures on the bone, as checked values. Reading it: documents/read_measures.h; measuring:
/// bone/measure/evaluate.h.
namespace kerf::documents {

/// What a landmark or construction is.
enum class Sort { point, line, plane };

/// A point, line or plane that is made of landmarks and of earlier constructions.
struct Construction {
    enum class Kind {
        middle,   ///< the mean of points
        line,     ///< of least squares through points, from the first towards the last
        plane,    ///< of least squares through points
        mirror,   ///< the plane of symmetry of pairs of points
        tangent,  ///< the line that touches a border of the bone, as a plane shows it
        entry,    ///< the point where a line first meets the bone
    };
    std::string id;
    Kind kind = Kind::middle;
    std::vector<std::string> of{};     ///< points; of a mirror the left ones; of an entry one line
    std::vector<std::string> right{};  ///< of a mirror: the other point of each pair
    std::string in{};                  ///< of a tangent: the plane of projection
    std::string side{};                ///< of a tangent: "posterior" and so on, as written
    double within = 15e-3;             ///< [m] of a tangent: how far the border may lie from the way along its points

    [[nodiscard]] Sort sort() const noexcept {
        return kind == Kind::middle || kind == Kind::entry   ? Sort::point
               : kind == Kind::plane || kind == Kind::mirror ? Sort::plane
                                                             : Sort::line;
    }
    /// LPS; zero for a word that is none.
    [[nodiscard]] Vec3 side_direction() const noexcept {
        if (side == "left") return {1, 0, 0};
        if (side == "right") return {-1, 0, 0};
        if (side == "posterior") return {0, 1, 0};
        if (side == "anterior") return {0, -1, 0};
        if (side == "superior") return {0, 0, 1};
        return side == "inferior" ? Vec3{0, 0, -1} : Vec3{};
    }
};

/// A number that is measured before the first cut and when each step has ended.
struct Measure {
    enum class Kind {
        angle,             ///< [rad] between two lines or planes, or as a plane shows them
        distance,          ///< [m] between points, lines and planes
        thickness,         ///< [m] of the bone at a point, along a line
        surface_distance,  ///< [m] of a point to the bone's surface, negative inside
        roughness,         ///< [m] of the border that a tangent touches
        difference,        ///< [rad] or [m] of a measure from another one, such as the planned angle; signed
    };
    std::string id;
    Kind kind = Kind::angle;
    std::string of{};  ///< the first thing; of a thickness its point; of a difference an earlier measure
    std::string to{};  ///< the second thing; of a thickness its line; of a difference what is subtracted; else empty
    std::string in{};  ///< of an angle: the plane in which both are seen; empty: in space

    bool is_of_angles = false;  ///< of a difference
    [[nodiscard]] bool is_angle() const noexcept { return kind == Kind::angle || is_of_angles; }
    /// Whether a value below 0 exists.
    [[nodiscard]] bool is_signed() const noexcept { return kind == Kind::surface_distance || kind == Kind::difference; }
    /// For people.
    [[nodiscard]] const char* unit() const noexcept { return is_angle() ? "deg" : "mm"; }
};

/// What a measure read, or why it could not.
struct MeasureReading {
    std::optional<double> value{};  ///< [rad] or [m]
    double uncertainty = 0.0;       ///< the same unit; standard uncertainty: root mean square about the value
    std::string why_not{};          ///< part of a sentence, without a stop; empty with a value
};

inline constexpr std::size_t max_measures = 64;             ///< of one procedure; as many constructions
inline constexpr std::size_t max_construction_points = 32;  ///< of one construction: each is moved for the uncertainty

}  // namespace kerf::documents
