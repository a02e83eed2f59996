// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/anatomy.h"
#include "documents/procedure.h"
#include "documents/station.h"
#include "documents/yaml/map_shape.h"

/// The one table of the keys of all documents. A row names a key, and the member that it fills; a row without a member
/// is read by the code of its section. One file has the shapes of one section. A reader asserts that its
/// shape has each key that it reads, and that it has read each key of its shape.
namespace kerf::documents::shapes {

// procedure.cpp
extern const MapShape<Procedure> metadata, needs, accuracy, budget, haptics;
extern const MapShape<Variant> variant;
extern const MapShape<ZoneDisplay> zone_display;
extern const MapShape<ScoredMetric> scored_metric;
extern const MapShape<MakeRequest> made_bone;
extern const Shape procedure;

// instrument.cpp
extern const MapShape<Sleeve> guide;
extern const MapShape<Instrument> instrument;

// bound.cpp
extern const Shape entry_goal, depth_goal, signal_goal, depth_bound, clearance_bound, separated_goal, held_goal,
    moved_bound, thrust_bound, angle_bound, offset_bound, reduction_offset_bound, reduction_angle_bound,
    axes_angle_bound, tip_apex_bound, flatness_bound, hole_angle_bound, hole_offset_bound, excess_bound, plunge_bound,
    air_bound, torque_bound, lateral_force_bound, removed_goal, removed_bound, speed_bound, duration_bound,
    signal_bound, measure_bound;
extern const MapShape<Limit> breach_bound;
extern const text::QuantityNeed angle_of_measure, angle_of_difference, length_of_measure;

// step.cpp
extern const Shape goal;
extern const MapShape<Limit> limit;
extern const MapShape<Step> step;

// rehearsal.cpp
extern const MapShape<Rehearsal> expectation, hand, rehearsal;
extern const MapShape<Waypoint> stop, until, turn, waypoint;
extern const Shape follow;

// implant.cpp
extern const MapShape<ImplantHole> implant_hole;
extern const MapShape<ImplantPlace> implant_place;
extern const MapShape<Implant> implant;

// measure.cpp
extern const Shape mirror, axis_entry, construction, angle_measure, distance_measure, thickness_measure,
    surface_measure, roughness_measure, difference_measure, measure;
extern const MapShape<Construction> tangent;

// solid.cpp
extern const MapShape<BoxSolid> box;
extern const MapShape<TubeSolid> tube;
extern const MapShape<EllipticTubeSolid> elliptic_tube;
extern const MapShape<SphereSolid> sphere;
extern const MapShape<SuperellipsoidSolid> superellipsoid;
extern const MapShape<LoftSection> loft_section;
extern const MapShape<LoftSolid> loft;
extern const Shape tissue_solid, zone_solid;
extern const MapShape<PhantomPart> part;

// bone_source.cpp
extern const Shape phantom;
extern const MapShape<CtSource> labels, kept_piece, ct;
extern const MapShape<DensityLine> density_line;
extern const MapShape<MeshSource> repair, canal, mesh;

// landmark.cpp
extern const MapShape<LandmarkFit> fit_residual, sphere_fit, tube_fit, neck_fit, condyles_fit, point_fit, axis_fit;
extern const MapShape<LandmarkPoint> point;
extern const MapShape<LandmarkAxis> axis;
extern const MapShape<LandmarkPlane> plane;
extern const Shape markup_name, landmarks;
extern const MapShape<MarkupsFile> markups;

// anatomy.cpp
extern const MapShape<Anatomy> anatomy_metadata;
extern const MapShape<TissueRegion> tissue_region;
extern const MapShape<Tissue> tissue;
extern const MapShape<Fracture> fracture_turn, fracture;
extern const Shape anatomy;

// station.cpp
extern const MapShape<DeviceStation> device_axes, station_device;
extern const MapShape<Box> workspace;
extern const Shape station;

}  // namespace kerf::documents::shapes
