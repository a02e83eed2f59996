// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

ValueOf<double> removed_volume() { return quantity(dimension::volume, "mm3", 1e-10, 1e-3); }

}  // namespace

const Shape entry_goal{"entry_goal", "The tool has met bone for the first time.", {}};

const Shape depth_goal{"depth_goal",
                       "Depth of the tip along the step's axis, from where the axis meets bone.",
                       {{required, "at_least", depth(), "As deep as this.", "30 mm"},
                        {optional, "at_most", depth(), "No deeper than this.", "38 mm"}}};

const Shape signal_goal{
    "signal_goal",
    "A signal of the step's force law, in any tick of the step; of an implant, as it is left.",
    {{required, "id", id(), "One of the law's signals; `kerf describe` lists them.", "drive_power"},
     {required, "at_least", of_kind(Kind::of_signal), "As much as this, in the signal's unit.", "1 W"},
     {optional, "at_most", of_kind(Kind::of_signal), "No more than this, in the signal's unit.", "30 W"}}};

const Shape depth_bound{"depth_bound",
                        "Depth of the tip along the step's axis, from where the axis meets bone.",
                        {{any_of, "at_least", depth(), "As deep as this.", "30 mm"},
                         {any_of, "at_most", depth(), "No deeper than this.", "38 mm"}}};

const Shape clearance_bound{"clearance_bound",
                            "Distance of the cutting region to a zone, negative inside.",
                            {{required, "zone", id(), "One of `needs.zones`.", "canal"},
                             {any_of, "at_least", length(-50.0_mm, 50.0_mm), "No nearer than this.", "0 mm"},
                             {any_of, "at_most", length(-50.0_mm, 50.0_mm), "No farther than this.", "20 mm"}}};

const Shape separated_goal{"separated_goal", "The bone has come apart, in this step or before.", {}};

const Shape held_goal{"held_goal", "The tool holds the piece that the step's axis leads into.", {}};

const Shape moved_bound{"moved_bound",
                        "The displacement of that piece, at the point where the axis meets it.",
                        {{required, "at_least", length(0.1_mm, 500.0_mm), "As far as this.", "60 mm"}}};

const Shape thrust_bound{
    "thrust_bound",
    "The force of the bone on the tool, against its feed.",
    {{required, "at_most", quantity(dimension::force, "N", 0.1_N, 1000.0_N), "No more than this.", "60 N"}}};

const Shape angle_bound{"angle_bound",
                        "The angle between the cut's wall and the step's plane.",
                        {{required, "at_most", angle(0.1_deg, 45.0_deg), "No more than this.", "3 deg"}}};

const Shape offset_bound{
    "offset_bound",
    "Distance of the cut's wall from the wall that a blade in the step's plane leaves, to either side.",
    {{required, "at_most", length(0.05_mm, 20.0_mm), "No farther than this.", "1 mm"}}};

const Shape reduction_offset_bound{"reduction_offset_bound",
                                   "How far the fragment of a fracture is from its place in the whole bone.",
                                   {{required, "at_most", length(0.05_mm, 200.0_mm), "No farther than this.", "2 mm"}}};

const Shape reduction_angle_bound{"reduction_angle_bound",
                                  "By how much it is turned from there.",
                                  {{required, "at_most", angle(0.1_deg, 180.0_deg), "No more than this.", "5 deg"}}};

const Shape axes_angle_bound{
    "axes_angle_bound",
    "The angle between two axes, each with the part of the bone that its middle is in.",
    {{required, "of", id(), "One axis of `needs.landmarks`, from `from` to `to`.", "right_pedicle"},
     {required, "to", id(), "The other one.", "right_pedicle"},
     {any_of, "at_least", angle(0.0, 180.0_deg), "No less than this.", "120 deg"},
     {any_of, "at_most", angle(0.0, 180.0_deg), "No more than this.", "135 deg"}}};

const Shape tip_apex_bound{
    "tip_apex_bound",
    "The distance of the tip from a point as seen from the front, plus the same in the side view that shows the neck.",
    {{required, "apex", id(), "A point of `needs.landmarks`, where the axis of the neck leaves the head.", "midline"},
     {required, "neck", id(), "An axis of `needs.landmarks`.", "right_pedicle"},
     {required, "at_most", length(0.1_mm, 200.0_mm), "No more than this.", "25 mm"}}};

const Shape flatness_bound{"flatness_bound",
                           "Distance between two parallel planes that enclose the cut's wall.",
                           {{required, "at_most", length(0.05_mm, 20.0_mm), "No more than this.", "0.5 mm"}}};

const Shape hole_angle_bound{"hole_angle_bound",
                             "The angle between the hole and the step's axis.",
                             {{required, "at_most", angle(0.1_deg, 90.0_deg), "No more than this.", "5 deg"}}};

const Shape hole_offset_bound{"hole_offset_bound",
                              "Distance of the hole's middle from the step's axis.",
                              {{required, "at_most", length(0.05_mm, 50.0_mm), "No farther than this.", "2 mm"}}};

const MapShape<Limit> breach_bound{
    "breach_bound",
    "How far a cylinder along the hole, such as a screw, leaves the bone.",
    {{required, "diameter", &Limit::diameter, length(0.5_mm, 50.0_mm), "The diameter of the cylinder.", "6.5 mm"},
     {required, "at_most", length(0.0_mm, 50.0_mm), "No farther than this.", "2 mm"}}};

const Shape excess_bound{
    "excess_bound",
    "Bone removed beyond what the tool takes on the step's axis.",
    {{required, "at_most", quantity(dimension::none, "%", 0.01, 100.0), "No more than this.", "50 %"}}};

const Shape plunge_bound{"plunge_bound",
                         "How far the tip goes on behind a face through which it leaves the bone.",
                         {{required, "at_most", length(0.1_mm, 200.0_mm), "No farther than this.", "5 mm"}}};

const Shape air_bound{
    "air_bound",
    "How long the tip goes on without bone in front of it, after it has met bone.",
    {{required, "at_most", quantity(dimension::time, "s", 0.01_s, 600.0_s), "No longer than this.", "1 s"}}};

const Shape torque_bound{
    "torque_bound",
    "The magnitude of the torque of the bone on the tool, about its shaft. The force scale does not change it.",
    {{required, "at_most", quantity(dimension::torque, "N m", 1.0_Nmm, 1e6_Nmm), "No more than this.", "3 N m"}}};

const Shape lateral_force_bound{
    "lateral_force_bound",
    "The force of the bone on the tool across its shaft. The force scale does not change it.",
    {{required, "at_most", quantity(dimension::force, "N", 0.1_N, 1000.0_N), "No more than this.", "20 N"}}};

const Shape removed_goal{"removed_goal",
                         "The volume of bone that the step has removed.",
                         {{required, "at_least", removed_volume(), "As much as this.", "100 mm3"},
                          {optional, "at_most", removed_volume(), "No more than this.", "500 mm3"}}};

const Shape removed_bound{"removed_bound",
                          "The volume of bone that the step has removed.",
                          {{required, "at_most", removed_volume(), "No more than this.", "500 mm3"}}};

const Shape speed_bound{
    "speed_bound",
    "The speed of the tip, along the shaft and across, while the tool runs in bone: averaged over 20 ms.",
    {{required, "at_most", speed(), "No faster than this.", "5 mm/s"}}};

const Shape duration_bound{
    "duration_bound",
    "The time since the step began.",
    {{required, "at_most", quantity(dimension::time, "s", 0.1_s, 3600.0_s), "No longer than this.", "60 s"}}};

const Shape signal_bound{
    "signal_bound",
    "A signal of the step's force law, in any tick of the step.",
    {{required, "id", id(), "One of the law's signals; `kerf describe` lists them.", "drive_power"},
     {any_of, "at_least", of_kind(Kind::of_signal), "As much as this, in the signal's unit.", "1 W"},
     {any_of, "at_most", of_kind(Kind::of_signal), "No more than this, in the signal's unit.", "30 W"}}};

const text::QuantityNeed angle_of_measure{dimension::angle, "deg", 0.0, 180.0_deg};

const text::QuantityNeed angle_of_difference{dimension::angle, "deg", -180.0_deg, 180.0_deg};

const text::QuantityNeed length_of_measure{dimension::length, "mm", -500.0_mm, 500.0_mm};

const Shape measure_bound{
    "measure_bound",
    "A measure of the bone, when the step has ended; as a goal, whenever the tool has come out of the bone.",
    {{required, "of", id(), "One of `measures`.", "cortex"},
     {any_of, "at_least", of_kind(Kind::of_measure), "As much as this: an angle or a length, as the measure is.",
      "2 mm"},
     {any_of, "at_most", of_kind(Kind::of_measure), "No more than this.", "8 mm"}}};

}  // namespace kerf::documents::shapes
