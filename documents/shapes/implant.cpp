// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {

const MapShape<ImplantHole> implant_hole{
    "implant_hole",
    "A screw hole of an implant, in the implant's frame.",
    {{required, "from", position(), "Where its axis begins, outside the bone.", "0 0 -10 mm"},
     {required, "to", position(), "Where its axis ends, inside the bone.", "0 0 60 mm"},
     {required, "diameter", &ImplantHole::diameter, length(0.5_mm, 50.0_mm),
      "Its narrowest diameter. A cylinder of 0.9 of it along the axis must be free of metal.", "8 mm"}}};

const MapShape<ImplantPlace> implant_place{
    "implant_place",
    "The planned pose of an implant: its origin where the axis first meets bone, its z along the axis.",
    {{required, "axis", &ImplantPlace::axis, id(), "One of `needs.landmarks`: an axis into the bone.", "right_pedicle"},
     {optional, "up", &ImplantPlace::up, direction(),
      "The direction that its x points to, as nearly as it can: LPS, towards the head if not given.", "0 0 1",
      "0 0 1"}}};

const MapShape<Implant> implant{
    "implant",
    "A solid of metal, in a frame of its own: z into the bone. `insert` puts this frame at the tool.",
    {{one_of, "mesh", map(mesh), "Its surface, closed.", "{file: plate.stl, unit: mm}"},
     {one_of, "parts", list(map(part)), "Its solids, added and taken away in this order.",
      "[{id: body, box: {centre: 0 0 -2.5 mm, size: 80 20 5 mm}}]"},
     {optional, "holes", named(map(implant_hole)), "Its screw holes; steps name them, as in `axis: plate.lag`.",
      "{lag: {from: 0 0 -10 mm, to: 0 0 60 mm, diameter: 8 mm}}"},
     {optional, "place", &Implant::place, map(implant_place),
      "Its planned pose in the anatomy, which must lie on bone.", "{axis: right_pedicle, up: 0 0 1}"}}};

}  // namespace kerf::documents::shapes
