// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bone/surface/edges.h"

/// What is wrong with a surface, counted and placed; nothing is changed. What can be mended: repair.h.
namespace kerf {

/// Something that can be counted, and the first place where it is [m].
struct Flaw {
    std::size_t count = 0;
    Vec3 at{};
};

/// A loop of border edges.
struct Opening {
    Vec3 at{};            ///< [m] its middle
    double length = 0.0;  ///< [m] along the border
    double width = 0.0;   ///< [m] diagonal of the box around it
};

[[nodiscard]] Opening opening_of(const SurfaceMesh& mesh, const BorderLoop& loop);

/// What hangs together over edges.
struct SurfacePiece {
    std::size_t faces = 0;
    double volume = 0.0;  ///< [m³] negative when inside out; means something only when it is closed
    Box bounds{};
};

struct SurfaceDiagnosis {
    std::size_t vertices = 0, faces = 0;
    Box bounds{};                      ///< [m]
    double area = 0.0;                 ///< [m²]
    double volume = 0.0;               ///< [m³] signed
    std::vector<SurfacePiece> pieces;  ///< the largest first

    Flaw open_edges;                    ///< with a face on one side only
    std::vector<Opening> openings;      ///< the widest first
    Flaw crowded_edges;                 ///< with more than two faces
    Flaw pinched_vertices;              ///< where parts of the surface touch in a point only
    Flaw turned_edges;                  ///< two faces that take different sides for the outside
    bool is_inside_out = false;         ///< closed, and its volume is negative
    Flaw duplicate_vertices;            ///< at exactly the place of an earlier one
    Flaw duplicate_faces;               ///< the vertices of an earlier one
    Flaw collapsed_faces;               ///< with one vertex twice
    Flaw flat_faces;                    ///< three vertices on a line
    Flaw crossings;                     ///< pairs of faces that cut through one another
    std::vector<Vec3> crossing_places;  ///< [m] one for each

    double float_step = 0.0;  ///< [m] what a float can tell apart at the farthest coordinate
    std::string likely_unit;  ///< "m": the size is no bone's, but would be in this unit; or empty

    [[nodiscard]] bool is_closed() const noexcept { return open_edges.count == 0; }
};

/// `unit` [m] is what the coordinates were multiplied by.   Pre: metres, LPS.   [any] pure.
[[nodiscard]] SurfaceDiagnosis diagnose(const SurfaceMesh& mesh, double unit);

/// The same as sentences for people; what is as it should be is not mentioned. No file, no path.
[[nodiscard]] std::vector<std::string> to_notes(const SurfaceDiagnosis& diagnosis);

/// "(12.1, -3.0, 44.7) mm"
[[nodiscard]] std::string place_text(Vec3 at);

}  // namespace kerf
