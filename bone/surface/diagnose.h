// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "bone/surface/edges.h"

/// Finds, counts and locates the flaws of a surface, without changes. repair.h lists the flaws that can be repaired.
namespace kerf::bone {

/// A kind of flaw: its number, and the position of the first one [m].
struct Flaw {
    std::size_t count = 0;
    Vec3 at{};
};

/// A loop of border edges.
struct Opening {
    Vec3 at{};            ///< [m] middle
    double length = 0.0;  ///< [m] along the border
    double width = 0.0;   ///< [m] diagonal of the box around it
};

[[nodiscard]] Opening opening_of(const SurfaceMesh& mesh, const BorderLoop& loop);

/// Faces that are connected over edges.
struct SurfacePiece {
    std::size_t faces = 0;
    double volume = 0.0;  ///< [m³] negative when inside out; meaningful for closed surfaces only
    Box bounds{};
};

/// A pair of faces that intersect or overlap.
struct FaceCrossing {
    Vec3 at{};                            ///< [m] a corner of one
    std::array<std::size_t, 2> pieces{};  ///< of the faces, among the diagnosed ones
};

struct SurfaceDiagnosis {
    std::size_t vertices = 0, faces = 0;
    Box bounds{};                      ///< [m]
    double area = 0.0;                 ///< [m²]
    double volume = 0.0;               ///< [m³] signed
    std::vector<SurfacePiece> pieces;  ///< the largest first

    Flaw open_edges;                     ///< with one face only
    std::vector<Opening> openings;       ///< the widest first
    Flaw nonmanifold_edges;              ///< with more than two faces
    Flaw pinched_vertices;               ///< where parts of the surface touch only in a point
    Flaw inconsistent_edges;             ///< between two faces with opposite orientation
    bool is_inside_out = false;          ///< closed, and its volume is negative
    Flaw duplicate_vertices;             ///< at exactly the position of an earlier one
    Flaw duplicate_faces;                ///< with the vertices of an earlier one
    Flaw collapsed_faces;                ///< with one vertex twice
    Flaw flat_faces;                     ///< three vertices on a line
    Flaw crossings;                      ///< pairs of faces that intersect
    std::vector<FaceCrossing> crossing;  ///< one for each pair
    std::vector<FaceCrossing> touching;  ///< pairs of faces in one plane that overlap, with opposite normals

    double float_step = 0.0;  ///< [m] resolution of a float at the farthest coordinate
    std::string likely_unit;  ///< "m": the size fits no bone, but would in this unit; or empty

    [[nodiscard]] bool is_closed() const noexcept { return open_edges.count == 0; }
};

/// Returns the diagnosis of a surface. `unit` [m] is the factor that the coordinates were multiplied by.
/// Pre: metres, LPS.   [any] pure.
[[nodiscard]] SurfaceDiagnosis diagnose(const SurfaceMesh& mesh, double unit);

/// Returns the diagnosis as sentences for people, without file names. Properties without a flaw are not mentioned.
[[nodiscard]] std::vector<std::string> to_notes(const SurfaceDiagnosis& diagnosis);

/// Returns a position as text: "(12.1, -3.0, 44.7) mm".
[[nodiscard]] std::string position_text(Vec3 at);

}  // namespace kerf::bone
