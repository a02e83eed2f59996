// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

using Fit = LandmarkFit::Shape;
using Lies = LandmarkPoint::Lies;
ValueOf<double> fitted_radius() { return length(2.0_mm, 100.0_mm); }
ValueOf<double> fitted_within() { return length(0.1_mm, 50.0_mm); }
/// The key decides which shape is fitted.
auto fitted_as(Fit shape) {
    return [shape](LandmarkFit& fit) -> LandmarkFit& {
        fit.shape = shape;
        return fit;
    };
}

}  // namespace

const MapShape<LandmarkFit> fit_residual{"fit_residual",
                                         "How well the bone must have the shape that is fitted.",
                                         {{required, "at_most", &LandmarkFit::residual, length(0.01_mm, 20.0_mm),
                                           "The root mean square of the distances from the shape.", "1 mm"}}};

const MapShape<LandmarkFit> sphere_fit{
    "sphere_fit",
    "A sphere on the surface, such as the head of a femur.",
    {{required, "radius", &LandmarkFit::radius, fitted_radius(), "About its radius: within 30 %.", "23 mm"},
     {optional, "within", &LandmarkFit::within, fitted_within(),
      "How far its centre may be from the position that is written.", "12 mm", "15 mm"}}};

const MapShape<LandmarkFit> tube_fit{
    "tube_fit",
    "A round stretch of bone between `from` and `to`, such as a shaft: the axis is its own.",
    {{required, "radius", &LandmarkFit::radius, fitted_radius(), "About its radius: within 30 %.", "14 mm"},
     {optional, "within", &LandmarkFit::within, fitted_within(),
      "How far its axis may be from the ends that are written.", "12 mm", "15 mm"}}};

const MapShape<LandmarkFit> neck_fit{
    "neck_fit",
    "A neck: the axis passes through the centre of its head and the middle of its narrowest part.",
    {{required, "head", &LandmarkFit::reference, id(), "A point that is fitted to a sphere.", "head"},
     {optional, "within", &LandmarkFit::within, fitted_within(),
      "How far the axis may be from the ends that are written.", "12 mm", "15 mm"}}};

const MapShape<LandmarkFit> condyles_fit{
    "condyles_fit",
    "The posterior condylar line: a plane parallel to the shaft touches both condyles from behind.",
    {{required, "shaft", &LandmarkFit::reference, id(), "An axis along the bone.", "shaft"},
     {optional, "within", &LandmarkFit::within, fitted_within(),
      "How far the line may be from the ends that are written.", "12 mm", "15 mm"}}};

const MapShape<LandmarkFit> point_fit{
    "point_fit",
    "What the point is of the bone: import finds it near `at`.",
    {{one_of, "sphere", fitted_as(Fit::sphere), map(sphere_fit), "The centre of a sphere.",
      "{radius: 23 mm, within: 12 mm}"},
     {optional, "residual", part_of(fit_residual), "How well the sphere must fit: the tolerance if not given.",
      "{at_most: 1 mm}"}}};

const MapShape<LandmarkFit> axis_fit{
    "axis_fit",
    "What the axis is of the bone: import finds it near `from` and `to`.",
    {{one_of, "tube", fitted_as(Fit::tube), map(tube_fit), "The axis of a round stretch of bone.",
      "{radius: 14 mm, within: 12 mm}"},
     {one_of, "neck", fitted_as(Fit::neck), map(neck_fit), "Through the centre of a head and along its neck.",
      "{head: head}"},
     {one_of, "condyles", fitted_as(Fit::condyles), map(condyles_fit),
      "Along the backs of two condyles, one at `from` and one at `to`.", "{shaft: shaft}"},
     {optional, "residual", part_of(fit_residual), "How well the shape must fit: the tolerance if not given.",
      "{at_most: 1 mm}"}}};

const MapShape<LandmarkPoint> point{
    "point",
    "A point.",
    {{required, "at", &LandmarkPoint::at, position(),
      "Where it is: LPS, x to the patient's left, y to the back, z to the head.", "0 26 5 mm"},
     {required, "tolerance", &LandmarkPoint::tolerance, tolerance(), "The uncertainty of its position.", "1.5 mm"},
     {optional, "lies", &LandmarkPoint::lies,
      choice<Lies>({{"on_bone", Lies::on_bone}, {"in_bone", Lies::in_bone}, {"off_bone", Lies::off_bone}}),
      "Its relation to the bone, which import checks within the tolerance.", "on_bone"},
     {optional, "fit", &LandmarkPoint::fit, map(point_fit), "How import finds it from the bone, near `at`.",
      "{sphere: {radius: 23 mm, within: 12 mm}}"}}};

const MapShape<LandmarkAxis> axis{
    "axis",
    "An axis into the bone.",
    {{required, "from", position(), "Where it begins, outside the bone.", "-23.5 47 5 mm"},
     {required, "to", position(), "Where it ends, inside the bone.", "-9.9 -6 5 mm"},
     {required, "tolerance", &LandmarkAxis::tolerance, tolerance(), "The uncertainty of its position.", "1.5 mm"},
     {optional, "fit", &LandmarkAxis::fit, map(axis_fit), "How import finds it from the bone, near `from` and `to`.",
      "{tube: {radius: 14 mm, within: 12 mm}}"}}};

const MapShape<LandmarkPlane> plane{
    "plane",
    "A flat cut, or a face.",
    {{required, "at", &LandmarkPlane::at, position(), "A point in it.", "0 0 120 mm"},
     {required, "normal", &LandmarkPlane::normal, direction(), "The direction of its normal.", "0 0 1"},
     {required, "tolerance", &LandmarkPlane::tolerance, tolerance(), "The uncertainty of its position.", "1.5 mm"}}};

const Shape markup_name{"markup_name",
                        "What a markup is called here.",
                        {{required, "label", text(), "What the file calls it.", "F-1"},
                         {required, "id", id(), "The landmark that it is.", "entry"}}};

const MapShape<MarkupsFile> markups{
    "markups",
    "Landmarks that 3D Slicer wrote: points, lines as axes, planes.",
    {{required, "file", &MarkupsFile::file, path(),
      "`.mrk.json` or `.fcsv`, in this document's folder or in KERF_DATA.", "scans/entry.mrk.json"},
     {required, "tolerance", &MarkupsFile::tolerance, tolerance(), "The uncertainty of all of them.", "2 mm"},
     {optional, "names", list(map(markup_name)), "Other names than the file's.", "[{label: F-1, id: entry}]"}}};

const Shape landmarks{"landmarks",
                      "Named positions that procedures use.",
                      {{optional, "points", named(map(point)), "Points.", "{head: {at: 0 26 5 mm, tolerance: 1.5 mm}}"},
                       {optional, "axes", named(map(axis)), "Axes into the bone.",
                        "{right_pedicle: {from: -23.5 47 5 mm, to: -9.9 -6 5 mm, tolerance: 1.5 mm}}"},
                       {optional, "planes", named(map(plane)), "Flat cuts.",
                        "{resection: {at: 0 0 120 mm, normal: 0 0 1, tolerance: 1.5 mm}}"},
                       {optional, "markups", list(map(markups)), "Files of 3D Slicer's markups.",
                        "[{file: scans/entry.mrk.json, tolerance: 2 mm}]"}}};

}  // namespace kerf::documents::shapes
