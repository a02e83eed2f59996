// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {

const Shape mirror{"mirror",
                   "The plane of symmetry of pairs of points, such as the landmarks of both sides of a skull.",
                   {{required, "left", list(id()), "The left point of each pair.", "[midline]"},
                    {required, "right", list(id()), "The right points, in the same order.", "[other_end]"}}};

const MapShape<Construction> tangent{
    "tangent",
    "The line that touches a border of the bone at two points, as a ruler does that is pressed against its middle.",
    {{required, "along", list(id()), "The points along which the border leads; the line has this direction.",
      "[midline, other_end]"},
     {required, "in", id(), "The plane in which the border is seen, such as the sagittal one.", "resection"},
     {required, "side", &Construction::side, word({"anterior", "posterior", "superior", "inferior", "left", "right"}),
      "The side from which the ruler touches.", "posterior"},
     {optional, "within", &Construction::within, length(1.0_mm, 100.0_mm),
      "How far the border may lie from the straight way between the points.", "15 mm", "15 mm"}}};

const Shape axis_entry{"axis_entry",
                       "The point where a line first meets the bone.",
                       {{required, "of", id(), "An axis or line.", "right_pedicle"}}};

const Shape construction{
    "construction",
    "A point, line or plane that is made of landmarks, and of the constructions above it.",
    {{one_of, "middle", list(id()), "The mean of points.", "[midline, other_end]"},
     {one_of, "line", list(id()), "The line through points, from the first towards the last.", "[midline, other_end]"},
     {one_of, "plane", list(id()), "The plane through three or more points.", "[midline, other_end, third_end]"},
     {one_of, "mirror", map(mirror), "The plane of symmetry of pairs of points.",
      "{left: [midline], right: [other_end]}"},
     {one_of, "tangent", map(tangent), "The line that touches a border of the bone.",
      "{along: [midline, other_end], in: resection, side: posterior}"},
     {one_of, "entry", map(axis_entry), "The point where a line first meets the bone.", "{of: right_pedicle}"}}};

const Shape angle_measure{
    "angle_measure",
    "The angle between two lines, a line and a plane, or two planes.",
    {{required, "of", id(), "An axis, line or plane.", "right_pedicle"},
     {required, "to", id(), "Another one.", "resection"},
     {optional, "in", id(), "The plane in which both are seen, such as the sagittal one; in space if not given.",
      "resection"}}};

const Shape distance_measure{"distance_measure",
                             "The shortest distance between points, lines and planes.",
                             {{required, "of", id(), "A point, line or plane.", "midline"},
                              {required, "to", id(), "Another one; a plane goes with a point.", "resection"}}};

const Shape thickness_measure{
    "thickness_measure",
    "The thickness of the bone straight through a point, or of the first bone behind it.",
    {{required, "at", id(), "A point.", "midline"},
     {required, "along", id(), "An axis or line, of which only the direction counts.", "right_pedicle"}}};

const Shape surface_measure{"surface_measure",
                            "The distance of a point to the bone's surface, negative inside.",
                            {{required, "of", id(), "A point.", "midline"}}};

const Shape roughness_measure{
    "roughness_measure",
    "The unevenness of a border: the root mean square distance of its outline from a smooth curve.",
    {{required, "of", id(), "A tangent of `constructions`, which says where the border is.", "right_pedicle"}}};

const Shape difference_measure{
    "difference_measure",
    "How much larger one measure is than another, such as the planned one.",
    {{required, "of", id(), "A measure above this one.", "wall"},
     {required, "from", id(), "Another one, which is subtracted: two angles, or two lengths.", "planned_wall"}}};

const Shape measure{
    "measure",
    "A number that is measured before the first cut and when each step has ended.",
    {{one_of, "thickness", map(thickness_measure), "The thickness of the bone at a point, along an axis.",
      "{at: midline, along: right_pedicle}"},
     {one_of, "distance", map(distance_measure), "The distance between points, lines and planes.",
      "{of: midline, to: resection}"},
     {one_of, "surface_distance", map(surface_measure), "The distance of a point to the bone's surface.",
      "{of: midline}"},
     {one_of, "roughness", map(roughness_measure), "The unevenness of the border that a tangent touches.",
      "{of: right_pedicle}"},
     {one_of, "angle", map(angle_measure), "The angle between lines and planes.", "{of: right_pedicle, to: resection}"},
     {one_of, "difference", map(difference_measure), "How much larger one measure is than another.",
      "{of: wall, from: planned_wall}"}}};

}  // namespace kerf::documents::shapes
