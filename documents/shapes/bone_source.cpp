// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

using Intensity = CtSource::Intensity;
ValueOf<double> density(double min, double max) { return quantity(dimension::density, "g/cm3", min, max); }
/// The labels of bone: numbers, and names.
struct LabelList : ValueShape {};
void read_value(MapReader& map, const std::string& key, const LabelList& /*shape*/, CtSource& ct) {
    map.labels(key, ct.keep, ct.keep_named);
}
ValueShape label() { return {.kind = Kind::label, .need = {dimension::none, "", 1.0, 65535.0}}; }

}  // namespace

const Shape phantom{"phantom",
                    "Bone out of solids.",
                    {{required, "parts", list(map(part)), "Added and taken away in this order.",
                      "[{id: body, box: {centre: 0 0 0 mm, size: 44 35 28 mm}}]"}}};

const MapShape<CtSource> labels{
    "labels",
    "Which voxels are this bone, by a label map or a segmentation.",
    {{required, "file", &CtSource::labels, path(), "In this document's folder or in KERF_DATA.", "scans/labels.nrrd"},
     {required, "keep", [](CtSource& source) -> CtSource& { return source; }, LabelList{list(label())},
      "What is this bone: numbers, or the names that a segmentation of 3D Slicer gives.", "[22]"}}};

const MapShape<CtSource> kept_piece{
    "kept_piece",
    "Which piece of what is bright, or has the labels, is this bone.",
    {{required, "component_at", &CtSource::component_at, id(), "A landmark point in it or beside it.", "body_centre"}}};

const MapShape<DensityLine> density_line{
    "density_line",
    "Density of the last tissue out of a voxel's value: at_zero + per_unit × value.",
    {{required, "at_zero", &DensityLine::at_zero, density(-3.0_g_per_cm3, 3.0_g_per_cm3), "Where the value is 0.",
      "-0.1 g/cm3"},
     {required, "per_unit", &DensityLine::per_unit, density(-3.0_g_per_cm3, 3.0_g_per_cm3),
      "For each HU or grey level.", "0.001 g/cm3"},
     {required, "floor", &DensityLine::floor, density(0.01_g_per_cm3, 3.0_g_per_cm3), "Never less than this.",
      "0.1 g/cm3"},
     {required, "source", &DensityLine::source, text(), "The source of this line.", "Rho et al. 1995."}}};

const MapShape<CtSource> ct{
    "ct",
    "Bone out of a CT.",
    {{required, "image", &CtSource::image, path(),
      "A file, or a folder with a DICOM series; in this document's folder or in KERF_DATA.", "scans/bone.nii.gz"},
     {optional, "series", &CtSource::series, text(),
      "Which series of the folder, as `kerf import` offers them; needed if there are several.", "4"},
     {optional, "acquisition", &CtSource::acquisition, text(),
      "Which acquisition of the series, as `kerf import` offers them; needed if several show the same part.", "1"},
     {optional, "resample", &CtSource::may_resample, yes_no(),
      "Gaps between slices may be filled from their neighbours.", "true"},
     {optional, "intensity", &CtSource::intensity,
      choice<Intensity>({{"HU", Intensity::hounsfield}, {"grey", Intensity::grey}}),
      "What the values are: HU if not given; grey levels of a cone-beam CT are none.", "grey"},
     {optional, "labels", part_of(labels), "Which voxels are this bone; those above the threshold if not given.",
      "{file: scans/labels.nrrd, keep: [22]}"},
     {optional, "keep", part_of(kept_piece), "Which piece is this bone; without labels the largest if not given.",
      "{component_at: body_centre}"},
     {required, "threshold", &CtSource::threshold, number(-4000.0, 65535.0),
      "The value at the border of bone, in HU or grey levels.", "150"},
     {optional, "closing", &CtSource::closing, length(0.0_mm, 10.0_mm),
      "Narrower gaps in the mask are closed: a radius.", "2 mm"},
     {optional, "fill", &CtSource::fill, yes_no(), "Cavities without a way out count as bone.", "true"},
     {optional, "density", &CtSource::density, map(density_line), "Density of the last tissue, voxel by voxel.",
      "{at_zero: -0.1 g/cm3, per_unit: 0.001 g/cm3, floor: 0.1 g/cm3, source: A book.}"},
     {optional, "source", &CtSource::source, text(), "The source of the scan.", "A public collection."}}};

const MapShape<MeshSource> repair{
    "repair",
    "Repairs of a surface beyond those that are always safe.",
    {{optional, "holes_up_to", &MeshSource::holes_up_to, length(0.0_mm, 20.0_mm),
      "Holes no wider than this are closed.", "3 mm"},
     {optional, "pieces_under", &MeshSource::pieces_under, quantity(dimension::volume, "mm3", 0.0, 1e-6),
      "Smaller pieces are left out.", "10 mm3"},
     {optional, "inner", &MeshSource::inner,
      choice<InnerPieces>({{"hollow", InnerPieces::hollow}, {"solid", InnerPieces::solid}}),
      "The meaning of surfaces inside the outer one: cavities, or marks in solid bone.", "hollow"}}};

const MapShape<MeshSource> canal{
    "canal",
    "The marrow cavity: it holds no bone.",
    {{one_of, "file", &MeshSource::canal_file, path(), "A second surface, in the same unit and frame.",
      "meshes/canal.stl"},
     {one_of, "tube", map(tube), "A round rod.", "{from: 0 0 -100 mm, to: 0 0 100 mm, radius: 6 mm}"}}};

const MapShape<MeshSource> mesh{
    "mesh",
    "Bone out of a closed surface.",
    {{required, "file", &MeshSource::file, path(), "STL, OBJ or PLY, in this document's folder or in KERF_DATA.",
      "meshes/femur.stl"},
     {required, "unit", &MeshSource::unit, choice<double>({{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"um", 1e-6}}),
      "The length of 1 in the file: the formats do not store it.", "mm"},
     {optional, "frame", word({"LPS", "RAS"}), "The direction of its axes; LPS is assumed, and reported, if not given.",
      "LPS"},
     {optional, "repair", part_of(repair, "mesh.repair"), "Repairs that are allowed.", "{holes_up_to: 3 mm}"},
     {optional, "canal", map(canal), "The marrow cavity.", "{tube: {from: 0 0 -100 mm, to: 0 0 100 mm, radius: 6 mm}}"},
     {optional, "source", &MeshSource::source, text(), "The source of the surface.", "A public collection."}}};

}  // namespace kerf::documents::shapes
