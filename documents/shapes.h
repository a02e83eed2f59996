// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/yaml/shape.h"

/// The one table of what documents may say. A new key is a line here and the line that reads it; the reader stops at a
/// key that is not in its shape, and at the end of a map for a key of the shape that it never asked for.
namespace kerf::shapes {

extern const Shape implant, implant_hole, implant_place, procedure;
extern const Shape construction, mirror, tangent, axis_entry;
extern const Shape measure, angle_measure, distance_measure, thickness_measure, surface_measure, roughness_measure,
    difference_measure;
extern const Shape metadata, needs, accuracy, budget, haptics, instrument, guide;
extern const Shape step, goal, entry_goal, depth_bound, limit, clearance_bound, axes_angle_bound;
extern const Shape signal_bound, measure_bound, removed_goal;
extern const Shape rehearsal, expectation, hand, stop, turn, until, waypoint, follow, variant;

extern const Shape anatomy;
extern const Shape anatomy_metadata, phantom, part, box, tube, elliptic_tube, sphere;
extern const Shape fracture, fracture_turn;
extern const Shape fit_residual, sphere_fit, tube_fit, neck_fit, condyles_fit, point_fit, axis_fit;
extern const Shape ct, labels, kept_piece, density_line;
extern const Shape mesh, repair, canal;
extern const Shape tissue, landmarks, point, axis, plane, markups, markup_name, tissue_solid, zone_solid;

/// What a bound on a measure must be.
extern const QuantityNeed angle_of_measure, angle_of_difference, length_of_measure;

}  // namespace kerf::shapes
