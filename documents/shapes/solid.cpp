// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {

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

const Shape tissue_solid{
    "tissue_solid",
    "One solid of a tissue.",
    {{one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
     {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
     {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
      "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
     {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"}}};

const Shape zone_solid{
    "zone_solid",
    "One solid of a zone.",
    {{one_of, "tissue", id(), "All solids of a tissue, as of the roots of teeth.", "root"},
     {one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
     {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
     {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
      "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
     {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"}}};

const MapShape<PhantomPart> part{
    "part",
    "A solid that is added to the bone, or taken away from the parts before it.",
    {{required, "id", &PhantomPart::id, id(), "Its name.", "body"},
     {one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
     {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
     {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
      "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
     {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"},
     {optional, "source", &PhantomPart::source, text(), "The source of its figures.", "Panjabi 1992."},
     {optional, "subtract", yes_no(), "Taken away instead of added.", "true"}}};

}  // namespace kerf::documents::shapes
