// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

ValueOf<double> density(double min, double max) { return quantity(dimension::density, "g/cm3", min, max); }

}  // namespace

const MapShape<Anatomy> anatomy_metadata{
    "anatomy_metadata",
    "What the anatomy is called.",
    {{required, "id", &Anatomy::id, id(), "The name that results use.", "vertebra-phantom"},
     {required, "title", &Anatomy::title, text(), "The name that people read.", "Third lumbar vertebra"}}};

const MapShape<TissueRegion> tissue_region{
    "tissue_region",
    "A region in which a tissue differs. The first one has precedence.",
    {{one_of, "part", id(), "A part of the phantom.", "body"},
     {one_of, "solids", list(map(tissue_solid)), "The union of these.",
      "[{sphere: {centre: 0 0 0 mm, radius: 12 mm}}]"},
     {any_of, "thickness", length(0.1_mm, 20.0_mm), "Of the shell there.", "0.45 mm"},
     {any_of, "density", density(0.05_g_per_cm3, 3.0_g_per_cm3), "Of the tissue there.", "1.7 g/cm3"},
     {optional, "over", &TissueRegion::over, length(0.1_mm, 50.0_mm),
      "The distance outside it across which it passes into the rest.", "2 mm", "2 mm"}}};

const MapShape<Tissue> tissue{
    "tissue",
    "The tissues of bone: shells from the surface inwards, or solids. The first one has precedence, the "
    "last one fills the "
    "rest.",
    {{required, "id", &Tissue::id, id(), "Its name.", "cortical"},
     {optional, "thickness", length(0.1_mm, 20.0_mm),
      "Of the shell. The last tissue has none; all others need it, or `solids`.", "1.5 mm"},
     {optional, "solids", list(map(tissue_solid)),
      "Where it is: their union, and of that the shell if there is a `thickness`. Not of the last.",
      "[{tube: {from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}}]"},
     {optional, "density", density(0.05_g_per_cm3, 3.0_g_per_cm3),
      "Needed, unless `ct.density` gives it to the last tissue.", "1.85 g/cm3"},
     {optional, "regions", list(map(tissue_region)), "Where its thickness or its density differs.",
      "[{solids: [{sphere: {centre: 0 0 0 mm, radius: 12 mm}}], thickness: 0.45 mm}]"},
     {optional, "source", &Tissue::source, text(), "The source of its figures.", "Silva et al. 1994."}}};

const MapShape<Fracture> fracture_turn{
    "fracture_turn",
    "How a fragment is turned about the fracture's `at`.",
    {{required, "by", &Fracture::turn, angle(-180.0_deg, 180.0_deg), "The angle.", "12 deg"},
     {required, "about", &Fracture::about, direction(), "The direction of the axis.", "0 1 0"}}};

const MapShape<Fracture> fracture{
    "fracture",
    "A flat break through the bone. Landmarks and zones are those of the whole bone.",
    {{required, "at", &Fracture::at, position(), "A point of the break.", "0 0 120 mm"},
     {required, "normal", &Fracture::normal, direction(),
      "The direction of its normal, into the fragment that has moved.", "0 0 1"},
     {optional, "gap", &Fracture::gap, length(0.1_mm, 20.0_mm), "The bone that is lost between the parts.", "0.5 mm",
      "0.5 mm"},
     {optional, "shift", &Fracture::shift, vector(dimension::length, "mm", -200.0_mm, 200.0_mm),
      "How far the fragment has moved (LPS).", "5 -3 8 mm"},
     {optional, "turn", part_of(fracture_turn), "How the fragment has turned.", "{by: 12 deg, about: 0 1 0}"}}};

const Shape anatomy{
    "anatomy",
    "Bone, tissues, and named positions.",
    {{required, "apiVersion", word({"kerf/v1"}), api_version_help, "kerf/v1"},
     {required, "kind", word({"Anatomy"}), "What this document describes.", "Anatomy"},
     {required, "metadata", map(anatomy_metadata), "What it is called.", "{id: bone, title: A bone}"},
     {one_of, "phantom", map(phantom), "Bone out of solids.",
      "{parts: [{id: body, box: {centre: 0 0 0 mm, size: 44 35 28 mm}}]}"},
     {one_of, "ct", map(ct), "Bone out of a CT.", "{image: scans/bone.nii.gz, threshold: 150}"},
     {one_of, "mesh", map(mesh), "Bone out of a closed surface.", "{file: meshes/femur.stl, unit: mm}"},
     {required, "tissues", list(map(tissue)), "From the surface inwards.",
      "[{id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3}, {id: cancellous, density: 0.25 g/cm3}]"},
     {required, "landmarks", map(landmarks), "Named positions that procedures use.",
      "{axes: {right_pedicle: {from: -23.5 47 5 mm, to: -9.9 -6 5 mm, tolerance: 1.5 mm}}}"},
     {optional, "fracture", map(fracture), "A break that parts the bone in two.", "{at: 0 0 120 mm, normal: 0 0 1}"},
     {optional, "zones", named(list(map(zone_solid))), "Regions that limits name, each the union of solids.",
      "{canal: [{tube: {from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}}]}"}}};

}  // namespace kerf::documents::shapes
