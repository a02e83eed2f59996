// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {

const MapShape<Sleeve> guide{
    "guide",
    "A fixed sleeve on the step's axis, through which the instrument works.",
    {{required, "bore", &Sleeve::bore, length(0.5_mm, 50.0_mm), "Its inner diameter, wider than the tool.", "3.4 mm"},
     {optional, "length", &Sleeve::length, length(1.0_mm, 300.0_mm), "From its mouth backwards.", "30 mm", "30 mm"},
     {optional, "gap", &Sleeve::gap, length(0.0_mm, 100.0_mm), "From its mouth to the planned entry.", "1 mm",
      "1 mm"}}};

const MapShape<Instrument> instrument{
    "instrument",
    "A tool and its force law, from a plugin.",
    {{required, "plugin", id(), "The plugin of both; `kerf list` names all.", "example.drilling"},
     {required, "tool", id(), "The tool of the plugin.", "twist_drill"},
     {required, "force", id(), "The force law of the plugin.", "drill_cutting"},
     {optional, "force_plugin", id(),
      "The plugin of the force law, if it is not that of the tool. The law must take any tool that "
      "has what it needs.",
      "example.drilling"},
     {optional, "parameters", of_kind(Kind::parameters), "Of tool and force; `kerf describe` lists them.",
      "{diameter: 3.2 mm}"},
     {optional, "guide", &Instrument::guide, map(guide, "guide"), "A sleeve that leads it along the step's axis.",
      "{bore: 3.4 mm}"},
     {optional, "remeshing", id(),
      "What the scene shows of it: the surface of the field (`isosurface`), also the implant that it leaves "
      "(`insert`), or an exact surface too, made by this strategy of a plugin; `kerf list` names all.",
      "example.drilling.groove", "isosurface"},
     {optional, "remeshing_parameters", of_kind(Kind::parameters), "Of the strategy; `kerf describe` lists them.",
      "{tolerance: 10 um}"},
     {optional, "hands", &Instrument::hands, choice<int>({{"one", 1}, {"two", 2}}),
      "How many hands hold it, if not as many as the tool demands.", "two"},
     {optional, "drives", of_kind(Kind::drives), "The speeds and positions of the tool's drives.",
      "{spindle_speed: 1000 rpm}"}}};

}  // namespace kerf::documents::shapes
