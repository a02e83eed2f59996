// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

constexpr const char* loft_example = "{up: 0 -1 0, sections: [{at: 0 0 -9 mm, width: 48 mm, height: 35 mm}, {at: 0 0 9 "
                                     "mm, width: 45 mm, height: 35 mm}]}";

}  // namespace

const MapShape<BoxSolid> box{"box",
                             "A box along the patient's axes.",
                             {{required, "centre", &BoxSolid::centre, position(), "Its centre.", "0 0 0 mm"},
                              {required, "size", &BoxSolid::size, vector(dimension::length, "mm", 0.1_mm, 2.0_m),
                               "Its whole edges along x, y and z.", "44 35 28 mm"}}};

const MapShape<TubeSolid> tube{
    "tube",
    "A round rod, cut flat.",
    {{required, "from", position(), "The middle of one end.", "0 26 -30 mm"},
     {required, "to", position(), "The middle of the other.", "0 26 30 mm"},
     {required, "radius", &TubeSolid::radius, extent(), "From its axis to its wall.", "8 mm"}}};

const MapShape<EllipticTubeSolid> elliptic_tube{
    "elliptic_tube",
    "A rod with an elliptic section, cut flat.",
    {{required, "from", position(), "The middle of one end.", "-20 34 5 mm"},
     {required, "to", position(), "The middle of the other.", "-14 12 5 mm"},
     {required, "width", &EllipticTubeSolid::width, extent(), "The whole section across `up`.", "10.3 mm"},
     {required, "height", &EllipticTubeSolid::height, extent(), "The whole section along `up`.", "14.9 mm"},
     {optional, "up", vector(dimension::none, "", -1.0, 1.0),
      "The direction in which `height` is measured; towards the head if not given.", "0 0 1"}}};

const MapShape<SphereSolid> sphere{
    "sphere",
    "A ball.",
    {{required, "centre", &SphereSolid::centre, position(), "Its centre.", "0 0 0 mm"},
     {required, "radius", &SphereSolid::radius, extent(), "From its centre to its surface.", "23 mm"}}};

const MapShape<SuperellipsoidSolid> superellipsoid{
    "superellipsoid",
    "An ellipsoid, or a body between it and a box with round edges.",
    {{required, "centre", &SuperellipsoidSolid::centre, position(), "Its centre.", "0 0 0 mm"},
     {required, "length", &SuperellipsoidSolid::length, extent(), "Its whole axis along `along`.", "30 mm"},
     {required, "width", &SuperellipsoidSolid::width, extent(), "Its whole axis across both.", "45 mm"},
     {required, "height", &SuperellipsoidSolid::height, extent(), "Its whole axis along `up`.", "35 mm"},
     {optional, "exponent", &SuperellipsoidSolid::exponent, number(1.5, 10.0),
      "2 for an ellipsoid, which it is if not given; more for a squarer body.", "2.2"},
     {optional, "along", vector(dimension::none, "", -1.0, 1.0),
      "The direction in which `length` is measured; towards the head if not given.", "0 0 1"},
     {optional, "up", vector(dimension::none, "", -1.0, 1.0),
      "The direction in which `height` is measured; to the back if not given.", "0 1 0"}}};

const MapShape<LoftSection> loft_section{
    "loft_section",
    "A section of a loft: a superellipse across its path, or a curve through points.",
    {{required, "at", &LoftSection::at, position(), "Its middle.", "0 0 -13.4 mm"},
     {optional, "width", &LoftSection::width, extent(), "The whole section across `up`.", "48 mm"},
     {optional, "height", &LoftSection::height, extent(), "The whole section along `up`.", "34.8 mm"},
     {optional, "outline", list(text()),
      "In place of width and height: points of a smooth closed curve from the middle, across `up` and along it, in any "
      "order of rotation that all sections share. All sections have as many.",
      "[-9 -6 mm, 9 -6 mm, 0 10 mm]"},
     {optional, "exponent", &LoftSection::exponent, number(1.5, 10.0),
      "2 for an ellipse, which it is if not given; more for a squarer section.", "2.2"},
     {optional, "taper", &LoftSection::taper, number(-0.9, 0.9),
      "The fraction of the width by which it is narrower on top, and wider below.", "0.4"},
     {optional, "turn", &LoftSection::turn, angle(-180.0_deg, 180.0_deg),
      "The angle of its height from `up`, about the path.", "10 deg"}}};

const MapShape<LoftSolid> loft{
    "loft",
    "A solid through sections along a smooth path, with flat ends.",
    {{required, "sections", list(map(loft_section)), "Two or more, from one end to the other.",
      "[{at: 0 0 -13 mm, width: 48 mm, height: 35 mm}, {at: 0 0 13 mm, width: 45 mm, height: 35 mm}]"},
     {required, "up", vector(dimension::none, "", -1.0, 1.0), "The direction in which `height` is measured.", "0 -1 0"},
     {optional, "rim", &LoftSolid::rim, length(0.0_mm, 100.0_mm),
      "The radius by which the edges of its ends are round.", "1.5 mm"}}};

const Shape tissue_solid{
    "tissue_solid",
    "One solid of a tissue.",
    {{one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
     {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
     {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
      "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
     {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"},
     {one_of, "superellipsoid", map(superellipsoid), "An ellipsoid, or a squarer body.",
      "{centre: 0 0 0 mm, length: 30 mm, width: 45 mm, height: 35 mm}"},
     {one_of, "loft", map(loft), "Sections along a path.", loft_example}}};

const Shape zone_solid{
    "zone_solid",
    "One solid of a zone.",
    {{one_of, "tissue", id(), "All solids of a tissue, as of the roots of teeth.", "root"},
     {one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
     {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
     {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
      "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
     {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"},
     {one_of, "superellipsoid", map(superellipsoid), "An ellipsoid, or a squarer body.",
      "{centre: 0 0 0 mm, length: 30 mm, width: 45 mm, height: 35 mm}"},
     {one_of, "loft", map(loft), "Sections along a path.", loft_example}}};

const MapShape<PhantomPart> part{
    "part",
    "A solid that is added to the bone, or taken away from the parts before it.",
    {{required, "id", &PhantomPart::id, id(), "Its name.", "body"},
     {one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
     {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
     {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
      "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
     {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"},
     {one_of, "superellipsoid", map(superellipsoid), "An ellipsoid, or a squarer body.",
      "{centre: 0 0 0 mm, length: 30 mm, width: 45 mm, height: 35 mm}"},
     {one_of, "loft", map(loft), "Sections along a path.", loft_example},
     {optional, "source", &PhantomPart::source, text(), "The source of its figures.", "Panjabi 1992."},
     {optional, "subtract", yes_no(), "Taken away instead of added.", "true"},
     {optional, "blend", &PhantomPart::blend, length(0.0_mm, 50.0_mm),
      "The radius of the fillet between it and the parts before it.", "3 mm"},
     {optional, "mirror", yes_no(), "Also on the other side of the plane x = 0.", "true"}}};

}  // namespace kerf::documents::shapes
