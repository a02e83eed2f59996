// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes.h"

#include <string>
#include <utility>
#include <vector>

#include "documents/procedure.h"
#include "kerf/units.hpp"

namespace kerf::shapes {
namespace {

using namespace literals;
using Kind = ValueShape::Kind;
using enum Presence;

ValueShape of_kind(Kind kind) { return {.kind = kind}; }
ValueShape text() { return of_kind(Kind::text); }
ValueShape id() { return of_kind(Kind::id); }
ValueShape version() { return of_kind(Kind::version); }
ValueShape path() { return of_kind(Kind::path); }
ValueShape yes_no() { return of_kind(Kind::yes_no); }
ValueShape word(std::vector<std::string> words) { return {.kind = Kind::word, .words = std::move(words)}; }
ValueShape word_or(std::vector<std::string> words, const Shape& shape) {
    return {.kind = Kind::word, .words = std::move(words), .shape = &shape};
}
ValueShape map(const Shape& shape) { return {.kind = Kind::map, .shape = &shape}; }
ValueShape map_or(const Shape& shape, const Shape& other) {
    return {.kind = Kind::map, .shape = &shape, .other = &other};
}
ValueShape list(ValueShape item) { return {.kind = Kind::list, .item = {std::move(item)}}; }
ValueShape named(ValueShape item) { return {.kind = Kind::named, .item = {std::move(item)}}; }

// Ranges are what a person can plausibly ask for; anything else is a slip of the pen or a wrong unit.
ValueShape quantity(kerf_dimension dimension, const char* unit, double min, double max) {
    return {.kind = Kind::quantity, .need = {dimension, unit, min, max}};
}
ValueShape number(double min, double max) { return quantity(dimension::none, "", min, max); }
ValueShape label() { return {.kind = Kind::label, .need = {dimension::none, "", 1.0, 65535.0}}; }
ValueShape length(double min, double max) { return quantity(dimension::length, "mm", min, max); }
ValueShape density(double min, double max) { return quantity(dimension::density, "g/cm3", min, max); }
ValueShape speed() { return quantity(dimension::speed, "mm/s", 0.01_mm_per_s, 500.0_mm_per_s); }
ValueShape driver_torque() { return quantity(dimension::torque, "N*m", 0.05, 20.0); }
ValueShape depth() { return length(-300.0_mm, 300.0_mm); }
ValueShape removed_volume() { return quantity(dimension::volume, "mm3", 1e-10, 1e-3); }
ValueShape extent() { return length(0.1_mm, 2.0_m); }
ValueShape fitted_radius() { return length(2.0_mm, 100.0_mm); }
ValueShape fitted_within() { return length(0.1_mm, 50.0_mm); }
ValueShape tolerance() { return length(0.0_mm, 20.0_mm); }
ValueShape vector(kerf_dimension dimension, const char* unit, double min, double max) {
    return {.kind = Kind::vector, .need = {dimension, unit, min, max}};
}
ValueShape position() { return vector(dimension::length, "mm", -2.0_m, 2.0_m); }

const char* const api_version_help = "The version of the format.";

}  // namespace

// ---- procedures: innermost first, since a shape names those within it
// ------------------------------------------------

const Shape metadata{"metadata",
                     "The name of the procedure, and its status.",
                     {
                         {required, "id", id(), "The name that files and results use.", "pilot-hole"},
                         {required, "title", text(), "The name that people read.", "Pilot hole for a pedicle screw"},
                         {required, "version", version(), "Increased with every change of the procedure.", "0.1.0"},
                         {required, "status", word({"draft", "piloted", "validated"}),
                          "How far it has been tested with people.", "draft"},
                         {optional, "authors", list(text()), "The authors.", "[The Kerf authors]"},
                     }};

const Shape needs{
    "needs",
    "What the anatomy must have, by name: a procedure holds no coordinates.",
    {
        {optional, "landmarks", list(id()), "Points, axes and planes.",
         "[right_pedicle, midline, resection, other_end, third_end]"},
        {optional, "zones", list(id()), "Regions that limits name.", "[canal]"},
        {optional, "tissues", list(id()), "Tissues that the bone must be made of.", "[cortical, cancellous]"},
    }};

const Shape accuracy{
    "accuracy",
    "The accuracy that the simulation needs.",
    {
        {optional, "spacing", length(0.05_mm, 2.0_mm), "Between the samples of the bone's distance field.", "0.25 mm",
         "0.25 mm"},
        {optional, "force", quantity(dimension::none, "%", 0.001, 0.5),
         "The largest error of force and torque that `kerf plan` may accept, against the finest field.", "7 %", "7 %"},
        {optional, "volume", quantity(dimension::none, "%", 0.0005, 0.5),
         "The largest error of the removed volume that `kerf plan` may accept.", "2 %", "2 %"},
    }};

const Shape budget{
    "budget",
    "The processor time that the simulation may use.",
    {
        {optional, "tick", quantity(dimension::time, "us", 1e-6, 1.0_ms),
         "Processor time of 999 ticks of 1000; `kerf plan` searches for settings that keep it.", "300 us", "300 us"},
    }};

const Shape haptics{
    "haptics",
    "The haptic device, and its coupling to the tool.",
    {
        {required, "device", id(), "The device whose inertia, friction and greatest force are simulated.", "touch"},
        {optional, "coupling", word({"solved", "direct"}),
         "`solved`, or `direct` to apply the force law to the device's own motion, as published methods do.", "solved",
         "solved"},
        {optional, "force_scale", number(1e-4, 10.0),
         "Device newton per bone newton; computed if not given, from `working_force` or from the steps.", "1/50"},
        {optional, "working_force", quantity(dimension::force, "N", 0.1_N, 1000.0_N),
         "The force of the bone that the device should hold with ease, at 0.6 of its continuous force; without it, "
         "that "
         "of the densest tissue at the steps' `feed`. `force_scale` has precedence.",
         "20 N"},
    }};

const Shape guide{
    "guide",
    "A fixed sleeve on the step's axis, through which the instrument works.",
    {
        {required, "bore", length(0.5_mm, 50.0_mm), "Its inner diameter, wider than the tool.", "3.4 mm"},
        {optional, "length", length(1.0_mm, 300.0_mm), "From its mouth backwards.", "30 mm", "30 mm"},
        {optional, "gap", length(0.0_mm, 100.0_mm), "From its mouth to the planned entry.", "1 mm", "1 mm"},
    }};

const Shape instrument{
    "instrument",
    "A tool and its force law, from a plugin.",
    {
        {required, "plugin", id(), "The plugin of both; `kerf list` names all.", "example.drilling"},
        {required, "tool", id(), "The tool of the plugin.", "twist_drill"},
        {required, "force", id(), "The force law of the plugin.", "drill_cutting"},
        {optional, "force_plugin", id(),
         "The plugin of the force law, if it is not that of the tool. The law must take any tool that "
         "has what it needs.",
         "example.drilling"},
        {optional, "parameters", of_kind(Kind::parameters), "Of tool and force; `kerf describe` lists them.",
         "{diameter: 3.2 mm}"},
        {optional, "guide", map(guide), "A sleeve that leads it along the step's axis.", "{bore: 3.4 mm}"},
        {optional, "remeshing", id(),
         "What the scene shows of it: the surface of the field (`isosurface`), also the implant that it leaves "
         "(`insert`), or an exact surface too, made by this strategy of a plugin; `kerf list` names all.",
         "example.drilling.groove", "isosurface"},
        {optional, "remeshing_parameters", of_kind(Kind::parameters), "Of the strategy; `kerf describe` lists them.",
         "{tolerance: 10 um}"},
        {optional, "hands", word({"one", "two"}), "How many hands hold it, if not as many as the tool demands.", "two"},
        {optional, "drives", of_kind(Kind::drives), "The speeds and positions of the tool's drives.",
         "{spindle_speed: 1000 rpm}"},
    }};

const Shape entry_goal{"entry_goal", "The tool has met bone for the first time.", {}};

const Shape depth_bound{"depth_bound",
                        "Depth of the tip along the step's axis, from where the axis meets bone.",
                        {
                            {any_of, "at_least", depth(), "As deep as this.", "30 mm"},
                            {any_of, "at_most", depth(), "No deeper than this.", "38 mm"},
                        }};

const Shape clearance_bound{"clearance_bound",
                            "Distance of the cutting region to a zone, negative inside.",
                            {
                                {required, "zone", id(), "One of `needs.zones`.", "canal"},
                                {any_of, "at_least", length(-50.0_mm, 50.0_mm), "No nearer than this.", "0 mm"},
                                {any_of, "at_most", length(-50.0_mm, 50.0_mm), "No farther than this.", "20 mm"},
                            }};

const Shape separated_goal{"separated_goal", "The bone has come apart, in this step or before.", {}};

const Shape held_goal{"held_goal", "The tool holds the piece that the step's axis leads into.", {}};

const Shape moved_bound{"moved_bound",
                        "The displacement of that piece, at the point where the axis meets it.",
                        {
                            {required, "at_least", length(0.1_mm, 500.0_mm), "As far as this.", "60 mm"},
                        }};

const Shape thrust_bound{
    "thrust_bound",
    "The force of the bone on the tool, against its feed.",
    {
        {required, "at_most", quantity(dimension::force, "N", 0.1_N, 1000.0_N), "No more than this.", "60 N"},
    }};

const Shape angle_bound{
    "angle_bound",
    "The angle between the cut's wall and the step's plane.",
    {
        {required, "at_most", quantity(dimension::angle, "deg", 0.1_deg, 45.0_deg), "No more than this.", "3 deg"},
    }};

const Shape offset_bound{
    "offset_bound",
    "Distance of the cut's wall from the wall that a blade in the step's plane leaves, to either side.",
    {
        {required, "at_most", length(0.05_mm, 20.0_mm), "No farther than this.", "1 mm"},
    }};

const Shape reduction_offset_bound{
    "reduction_offset_bound",
    "How far the fragment of a fracture is from its place in the whole bone.",
    {
        {required, "at_most", length(0.05_mm, 200.0_mm), "No farther than this.", "2 mm"},
    }};

const Shape reduction_angle_bound{
    "reduction_angle_bound",
    "By how much it is turned from there.",
    {
        {required, "at_most", quantity(dimension::angle, "deg", 0.1_deg, 180.0_deg), "No more than this.", "5 deg"},
    }};

const Shape axes_angle_bound{
    "axes_angle_bound",
    "The angle between two axes, each with the part of the bone that its middle is in.",
    {
        {required, "of", id(), "One axis of `needs.landmarks`, from `from` to `to`.", "right_pedicle"},
        {required, "to", id(), "The other one.", "right_pedicle"},
        {any_of, "at_least", quantity(dimension::angle, "deg", 0.0, 180.0_deg), "No less than this.", "120 deg"},
        {any_of, "at_most", quantity(dimension::angle, "deg", 0.0, 180.0_deg), "No more than this.", "135 deg"},
    }};

const Shape tip_apex_bound{
    "tip_apex_bound",
    "The distance of the tip from a point as seen from the front, plus the same in the side view that shows the neck.",
    {
        {required, "apex", id(), "A point of `needs.landmarks`, where the axis of the neck leaves the head.",
         "midline"},
        {required, "neck", id(), "An axis of `needs.landmarks`.", "right_pedicle"},
        {required, "at_most", length(0.1_mm, 200.0_mm), "No more than this.", "25 mm"},
    }};

const Shape flatness_bound{"flatness_bound",
                           "Distance between two parallel planes that enclose the cut's wall.",
                           {
                               {required, "at_most", length(0.05_mm, 20.0_mm), "No more than this.", "0.5 mm"},
                           }};

const Shape hole_angle_bound{
    "hole_angle_bound",
    "The angle between the hole and the step's axis.",
    {
        {required, "at_most", quantity(dimension::angle, "deg", 0.1_deg, 90.0_deg), "No more than this.", "5 deg"},
    }};

const Shape hole_offset_bound{"hole_offset_bound",
                              "Distance of the hole's middle from the step's axis.",
                              {
                                  {required, "at_most", length(0.05_mm, 50.0_mm), "No farther than this.", "2 mm"},
                              }};

const Shape breach_bound{"breach_bound",
                         "How far a cylinder along the hole, such as a screw, leaves the bone.",
                         {
                             {required, "diameter", length(0.5_mm, 50.0_mm), "The diameter of the cylinder.", "6.5 mm"},
                             {required, "at_most", length(0.0_mm, 50.0_mm), "No farther than this.", "2 mm"},
                         }};

const Shape excess_bound{
    "excess_bound",
    "Bone removed beyond what the tool takes on the step's axis.",
    {
        {required, "at_most", quantity(dimension::none, "%", 0.01, 100.0), "No more than this.", "50 %"},
    }};

const Shape plunge_bound{"plunge_bound",
                         "How far the tip goes on behind a face through which it leaves the bone.",
                         {
                             {required, "at_most", length(0.1_mm, 200.0_mm), "No farther than this.", "5 mm"},
                         }};

const Shape air_bound{
    "air_bound",
    "How long the tip goes on without bone in front of it, after it has met bone.",
    {
        {required, "at_most", quantity(dimension::time, "s", 0.01_s, 600.0_s), "No longer than this.", "1 s"},
    }};

const Shape torque_bound{
    "torque_bound",
    "The magnitude of the torque of the bone on the tool, about its shaft. The force scale does not change it.",
    {
        {required, "at_most", quantity(dimension::torque, "N m", 1.0_Nmm, 1e6_Nmm), "No more than this.", "3 N m"},
    }};

const Shape lateral_force_bound{
    "lateral_force_bound",
    "The force of the bone on the tool across its shaft. The force scale does not change it.",
    {
        {required, "at_most", quantity(dimension::force, "N", 0.1_N, 1000.0_N), "No more than this.", "20 N"},
    }};

const Shape removed_goal{"removed_goal",
                         "The volume of bone that the step has removed.",
                         {
                             {required, "at_least", removed_volume(), "As much as this.", "100 mm3"},
                             {optional, "at_most", removed_volume(), "No more than this.", "500 mm3"},
                         }};

const Shape removed_bound{"removed_bound",
                          "The volume of bone that the step has removed.",
                          {
                              {required, "at_most", removed_volume(), "No more than this.", "500 mm3"},
                          }};

const Shape speed_bound{
    "speed_bound",
    "The speed of the tip, along the shaft and across, while the tool runs in bone: averaged over 20 ms.",
    {
        {required, "at_most", speed(), "No faster than this.", "5 mm/s"},
    }};

const Shape duration_bound{
    "duration_bound",
    "The time since the step began.",
    {
        {required, "at_most", quantity(dimension::time, "s", 0.1_s, 3600.0_s), "No longer than this.", "60 s"},
    }};

const Shape signal_bound{
    "signal_bound",
    "A signal of the step's force law, in any tick of the step.",
    {
        {required, "id", id(), "One of the law's signals; `kerf describe` lists them.", "drive_power"},
        {any_of, "at_least", of_kind(Kind::of_signal), "As much as this, in the signal's unit.", "1 W"},
        {any_of, "at_most", of_kind(Kind::of_signal), "No more than this, in the signal's unit.", "30 W"},
    }};

const QuantityNeed angle_of_measure{dimension::angle, "deg", 0.0, 180.0_deg};
const QuantityNeed angle_of_difference{dimension::angle, "deg", -180.0_deg, 180.0_deg};
const QuantityNeed length_of_measure{dimension::length, "mm", -500.0_mm, 500.0_mm};

const Shape measure_bound{
    "measure_bound",
    "A measure of the bone, when the step has ended; as a goal, whenever the tool has come out of the bone.",
    {
        {required, "of", id(), "One of `measures`.", "cortex"},
        {any_of, "at_least", of_kind(Kind::of_measure), "As much as this: an angle or a length, as the measure is.",
         "2 mm"},
        {any_of, "at_most", of_kind(Kind::of_measure), "No more than this.", "8 mm"},
    }};

const Shape goal{"goal",
                 "What must be reached; goals are met in their order.",
                 {
                     {one_of, "entry", map(entry_goal), "The tool has met bone.", "{}"},
                     {one_of, "depth", map(depth_bound), "The tip is as deep as this.", "{at_least: 30 mm}"},
                     {one_of, "separated", map(separated_goal), "The bone has come apart.", "{}"},
                     {one_of, "held", map(held_goal), "The tool holds the piece.", "{}"},
                     {one_of, "moved", map(moved_bound), "The piece has been moved.", "{at_least: 60 mm}"},
                     {one_of, "removed_volume", map(removed_goal), "The step has removed as much bone as this.",
                      "{at_least: 100 mm3}"},
                     {one_of, "signal", map(signal_bound), "A signal of the law has been within this.",
                      "{id: drive_power, at_least: 1 W}"},
                     {one_of, "measure", map(measure_bound), "A measure of the bone is within this.",
                      "{of: cortex, at_least: 2 mm}"},
                 }};

const Shape limit{
    "limit",
    "What must not happen during the step.",
    {
        {one_of, "clearance", map(clearance_bound), "The distance of the cutting region to a zone.",
         "{zone: canal, at_least: 0 mm}"},
        {one_of, "depth", map(depth_bound), "The depth of the tip.", "{at_most: 38 mm}"},
        {one_of, "thrust", map(thrust_bound), "The thrust of the bone on the running tool.", "{at_most: 60 N}"},
        {one_of, "torque", map(torque_bound), "The torque of the bone about the shaft.", "{at_most: 3 N m}"},
        {one_of, "lateral_force", map(lateral_force_bound), "The force of the bone across the shaft.",
         "{at_most: 20 N}"},
        {one_of, "speed", map(speed_bound), "The speed of the tip in bone.", "{at_most: 5 mm/s}"},
        {one_of, "removed_volume", map(removed_bound), "The bone removed in the step.", "{at_most: 500 mm3}"},
        {one_of, "duration", map(duration_bound), "The time that the step takes.", "{at_most: 60 s}"},
        {one_of, "signal", map(signal_bound), "A signal of the law.", "{id: drive_power, at_most: 30 W}"},
        {one_of, "plane_angle", map(angle_bound),
         "The angle between the cut's wall and the step's plane, measured when the step has ended.",
         "{at_most: 3 deg}"},
        {one_of, "plane_offset", map(offset_bound),
         "The distance of the cut from the plane, measured when the step has ended.", "{at_most: 1 mm}"},
        {one_of, "flatness", map(flatness_bound), "The unevenness of the cut, measured when the step has ended.",
         "{at_most: 0.5 mm}"},
        {one_of, "hole_angle", map(hole_angle_bound),
         "The angle between the drilled hole and the axis, measured when the step has ended.", "{at_most: 5 deg}"},
        {one_of, "entry_offset", map(hole_offset_bound),
         "The distance of the hole from the axis where the drill had bitten, measured when the step has ended.",
         "{at_most: 2 mm}"},
        {one_of, "narrowest_offset", map(hole_offset_bound),
         "The same where the bone around the axis is narrowest, such as a pedicle's isthmus.", "{at_most: 2 mm}"},
        {one_of, "end_offset", map(hole_offset_bound), "The same where the hole ends.", "{at_most: 3 mm}"},
        {one_of, "breach", map(breach_bound),
         "How far a cylinder along the hole leaves the bone, measured when the step has ended.",
         "{diameter: 6.5 mm, at_most: 2 mm}"},
        {one_of, "excess_removal", map(excess_bound),
         "The bone removed beyond the planned hole, measured when the step has ended.", "{at_most: 50 %}"},
        {one_of, "reduction_offset", map(reduction_offset_bound),
         "The distance of a fracture's fragment from its place, at the fracture, measured when the step has ended.",
         "{at_most: 2 mm}"},
        {one_of, "reduction_angle", map(reduction_angle_bound),
         "The rotation of a fracture's fragment from its place, measured when the step has ended.", "{at_most: 5 deg}"},
        {one_of, "axes_angle", map(axes_angle_bound),
         "The angle between two axes, such as neck and shaft, measured when the step has ended.",
         "{of: right_pedicle, to: right_pedicle, at_most: 135 deg}"},
        {one_of, "tip_apex", map(tip_apex_bound),
         "The tip-apex distance of a screw in a femoral head, measured when the step has ended.",
         "{apex: midline, neck: right_pedicle, at_most: 25 mm}"},
        {one_of, "measure", map(measure_bound), "A measure of the bone, measured when the step has ended.",
         "{of: cortex, at_least: 2 mm}"},
        {one_of, "plunge", map(plunge_bound), "How far the tip plunges behind a far face.", "{at_most: 5 mm}"},
        {one_of, "time_in_air", map(air_bound), "How long the tip advances without bone in front of it.",
         "{at_most: 1 s}"},
        {required, "reason", text(), "The sentence that a trainee reads when it happens.",
         "The hole is deeper than planned."},
    }};

const Shape step{
    "step",
    "One thing to do.",
    {
        {required, "id", id(), "The name that results use.", "drill"},
        {required, "title", text(), "What to do, for the trainee.", "Drill the pilot hole"},
        {required, "instrument", id(), "One of `instruments`.", "pilot"},
        {required, "axis", id(),
         "One of `needs.landmarks`, or a hole of an implant, as in `plate.lag`; the tool should follow it.",
         "right_pedicle"},
        {optional, "plane", id(),
         "One of `needs.landmarks`; the flat side of a blade should lie in it, its y along the plane's normal.",
         "resection"},
        {required, "goals", list(map(goal)), "What must be reached, in this order.",
         "[{entry: {}}, {depth: {at_least: 30 mm}}]"},
        {optional, "limits", list(map(limit)), "What must not happen during the step.",
         "[{clearance: {zone: canal, at_least: 0 mm}, reason: The drill entered the canal.}]"},
        {optional, "feed", speed(), "The feed at which the tool is meant to work; the force scale follows from it.",
         "0.5 mm/s", "1 mm/s"},
        {optional, "allow", list(id()),
         "Events that spoil the tool and yet do not fail this step; `kerf describe` lists them.",
         "[drilling.bit_overbent]"},
    }};

const Shape expectation{
    "expectation",
    "The expected failure.",
    {
        {required, "fail", id(), "The one limit that breaks: its zone, event, signal or measure, or else its quantity.",
         "canal"},
        {optional, "step", id(), "The one step in which it breaks; any step if not given.", "drill"},
        {optional, "others", yes_no(), "Other limits may break as well, and goals be missed.", "true", "false"},
    }};

const Shape hand{"hand",
                 "The properties of the simulated hand.",
                 {
                     {optional, "feed", speed(), "The speed that it aims at in bone.", "1 mm/s", "1 mm/s"},
                     {optional, "approach", speed(), "Its speed in air.", "10 mm/s", "10 mm/s"},
                     {optional, "push", quantity(dimension::force, "N", 0.1_N, hardest_push),
                      "Its largest push, at the bone.", "60 N", "60 N"},
                     {optional, "reaction", quantity(dimension::time, "ms", 0.0_ms, 2000.0_ms), "Its reaction time.",
                      "150 ms", "150 ms"},
                 }};

const Shape stop{"stop",
                 "What makes the hand give up its way and go to the last waypoint.",
                 {
                     {required, "aside", length(0.1_mm, 100.0_mm), "The tip is so far beside the way.", "1 mm"},
                 }};

const Shape until{
    "until",
    "What ends the turn early. The hand feels it one reaction late.",
    {
        {one_of, "torque", driver_torque(), "The hand feels this torque of the bone against the turn.", "2 N*m"},
        {one_of, "event", id(), "The force of the step's instrument reports this event, such as that the head seats.",
         "drilling.stalled"},
    }};

const Shape turn{
    "turn",
    "How the hand turns the tool about its axis.",
    {
        {required, "by", quantity(dimension::angle, "turns", -1000.0_turns, 1000.0_turns),
         "Clockwise as the hand sees it, which drives a screw in; negative: back.", "18 turns"},
        {optional, "speed", quantity(dimension::frequency, "rpm", 0.1_rpm, 300.0_rpm), "The speed of the turn.",
         "30 rpm", "30 rpm"},
        {optional, "torque", driver_torque(),
         "The largest torque of the bone against which the hand turns on; if not given, it turns until the "
         "driver slips in it, at 5 N*m in one hand.",
         "3 N*m"},
        {optional, "until", map(until), "What ends the turn early; `by` is then the most.", "{torque: 2 N*m}"},
        {optional, "regrip", quantity(dimension::angle, "deg", 45.0_deg, 360.0_deg),
         "After each such angle the hand lets the driver go, turns back and takes hold again.", "180 deg"},
    }};

const Shape waypoint{
    "waypoint",
    "A position of the tool in the frame of a step's axis.",
    {
        {optional, "step", id(), "The step whose frame holds from here on; the first step until one is named.",
         "drill"},
        {required, "depth", depth(), "From the point where the axis meets bone; negative outside.", "32 mm"},
        {optional, "medial", length(-100.0_mm, 100.0_mm), "Sideways, towards the landmark `midline`.", "5 mm"},
        {optional, "medial_angle", quantity(dimension::angle, "deg", -60.0_deg, 60.0_deg),
         "The angle of the whole approach from the axis towards the landmark `midline`, about the point where the axis "
         "meets bone.",
         "20 deg"},
        {optional, "cranial_angle", quantity(dimension::angle, "deg", -60.0_deg, 60.0_deg),
         "The same from the axis towards the patient's head.", "10 deg"},
        {optional, "direction", word({"axis", "surface"}),
         "`surface`: depth and tool point straight into the bone's surface where the axis meets it, as for a starting "
         "hole.",
         "surface", "axis"},
        {optional, "aside", length(-100.0_mm, 100.0_mm), "Sideways in the step's plane, along the tool's x.", "2 mm"},
        {optional, "tilt", quantity(dimension::angle, "deg", -90.0_deg, 90.0_deg),
         "The rotation of the blade about the axis, out of the step's plane.", "6 deg"},
        {optional, "displaced", yes_no(),
         "Where the anatomy's fracture has moved it to, and not where it is in the whole bone.", "true", "false"},
        {optional, "speed", speed(), "The speed that the hand aims at on its way here; if not given, its own.",
         "0.5 mm/s"},
        {optional, "push", quantity(dimension::force, "N", 0.1_N, hardest_push),
         "Its largest push on the way here, at the bone; if not given, its own.", "20 N"},
        {optional, "stop", map(stop), "What makes the hand give up on the way here.", "{aside: 1 mm}"},
        {optional, "turn", map(turn),
         "The rotation of the tool on the way here, as of a screw. It sets the time of the way.", "{by: 18 turns}"},
        {optional, "drives", of_kind(Kind::drives), "The drives of the step's tool, set on arrival.",
         "{spindle_speed: 500 rpm}"},
        {optional, "insert", id(), "One of `implants`, which is inserted on arrival, at the tool.", "plate"},
        {optional, "place", id(), "One of `implants`, which is inserted on arrival, at its planned pose.", "plate"},
        {optional, "do", word({"undo", "redo", "remove", "fuse", "subtract", "release"}),
         "On arrival: undo or redo the last change of the bone, remove the held piece from the scene, fuse it with the "
         "piece next to it, subtract the tool's cutting region from the bone, or release an implant where it is.",
         "undo"},
    }};

const Shape follow{"follow",
                   "The waypoints of a path, at this place.",
                   {
                       {required, "follow", id(), "One of `paths`.", "approach"},
                   }};

const Shape rehearsal{
    "rehearsal",
    "The path of a simulated hand, and its expected result.",
    {
        {required, "id", id(), "Its name, for `--hand`.", "expert"},
        {optional, "title", text(), "What it shows.", "Along the planned axis"},
        {required, "expect", word_or({"pass", "incomplete"}, expectation),
         "`pass`, `incomplete` for goals that are not reached, or the limit that breaks.", "{fail: canal}"},
        {optional, "hand", map(hand), "The properties of the simulated hand.", "{feed: 1 mm/s, push: 60 N}"},
        {required, "path", list(map_or(waypoint, follow)),
         "The waypoints, at least two; `{follow: NAME}` has the waypoints of one of `paths`.",
         "[{depth: -5 mm}, {depth: 32 mm}]"},
    }};

const Shape variant{"variant",
                    "The procedure with a few values changed.",
                    {
                        {optional, "title", text(), "The difference from the procedure.", "Osteoporotic bone"},
                        {required, "patch", of_kind(Kind::patch),
                         "Paths of values, and the new values; ids address the items of lists, `~` removes.",
                         "{accuracy.spacing: 0.5 mm}"},
                    }};

const Shape implant_hole{
    "implant_hole",
    "A screw hole of an implant, in the implant's frame.",
    {
        {required, "from", position(), "Where its axis begins, outside the bone.", "0 0 -10 mm"},
        {required, "to", position(), "Where its axis ends, inside the bone.", "0 0 60 mm"},
        {required, "diameter", length(0.5_mm, 50.0_mm),
         "Its narrowest diameter. A cylinder of 0.9 of it along the axis must be free of metal.", "8 mm"},
    }};

const Shape implant_place{
    "implant_place",
    "The planned pose of an implant: its origin where the axis first meets bone, its z along the axis.",
    {
        {required, "axis", id(), "One of `needs.landmarks`: an axis into the bone.", "right_pedicle"},
        {optional, "up", vector(dimension::none, "", -1.0, 1.0),
         "The direction that its x points to, as nearly as it can: LPS, towards the head if not given.", "0 0 1",
         "0 0 1"},
    }};

const Shape implant{
    "implant",
    "A solid of metal, in a frame of its own: z into the bone. `insert` puts this frame at the tool.",
    {
        {one_of, "mesh", map(mesh), "Its surface, closed.", "{file: plate.stl, unit: mm}"},
        {one_of, "parts", list(map(part)), "Its solids, added and taken away in this order.",
         "[{id: body, box: {centre: 0 0 -2.5 mm, size: 80 20 5 mm}}]"},
        {optional, "holes", named(map(implant_hole)), "Its screw holes; steps name them, as in `axis: plate.lag`.",
         "{lag: {from: 0 0 -10 mm, to: 0 0 60 mm, diameter: 8 mm}}"},
        {optional, "place", map(implant_place), "Its planned pose in the anatomy, which must lie on bone.",
         "{axis: right_pedicle, up: 0 0 1}"},
    }};

const Shape mirror{"mirror",
                   "The plane of symmetry of pairs of points, such as the landmarks of both sides of a skull.",
                   {
                       {required, "left", list(id()), "The left point of each pair.", "[midline]"},
                       {required, "right", list(id()), "The right points, in the same order.", "[other_end]"},
                   }};

const Shape tangent{
    "tangent",
    "The line that touches a border of the bone at two points, as a ruler does that is pressed against its middle.",
    {
        {required, "along", list(id()), "The points along which the border leads; the line has this direction.",
         "[midline, other_end]"},
        {required, "in", id(), "The plane in which the border is seen, such as the sagittal one.", "resection"},
        {required, "side", word({"anterior", "posterior", "superior", "inferior", "left", "right"}),
         "The side from which the ruler touches.", "posterior"},
        {optional, "within", length(1.0_mm, 100.0_mm),
         "How far the border may lie from the straight way between the points.", "15 mm", "15 mm"},
    }};

const Shape axis_entry{"axis_entry",
                       "The point where a line first meets the bone.",
                       {
                           {required, "of", id(), "An axis or line.", "right_pedicle"},
                       }};

const Shape construction{
    "construction",
    "A point, line or plane that is made of landmarks, and of the constructions above it.",
    {
        {one_of, "middle", list(id()), "The mean of points.", "[midline, other_end]"},
        {one_of, "line", list(id()), "The line through points, from the first towards the last.",
         "[midline, other_end]"},
        {one_of, "plane", list(id()), "The plane through three or more points.", "[midline, other_end, third_end]"},
        {one_of, "mirror", map(mirror), "The plane of symmetry of pairs of points.",
         "{left: [midline], right: [other_end]}"},
        {one_of, "tangent", map(tangent), "The line that touches a border of the bone.",
         "{along: [midline, other_end], in: resection, side: posterior}"},
        {one_of, "entry", map(axis_entry), "The point where a line first meets the bone.", "{of: right_pedicle}"},
    }};

const Shape angle_measure{
    "angle_measure",
    "The angle between two lines, a line and a plane, or two planes.",
    {
        {required, "of", id(), "An axis, line or plane.", "right_pedicle"},
        {required, "to", id(), "Another one.", "resection"},
        {optional, "in", id(), "The plane in which both are seen, such as the sagittal one; in space if not given.",
         "resection"},
    }};

const Shape distance_measure{"distance_measure",
                             "The shortest distance between points, lines and planes.",
                             {
                                 {required, "of", id(), "A point, line or plane.", "midline"},
                                 {required, "to", id(), "Another one; a plane goes with a point.", "resection"},
                             }};

const Shape thickness_measure{
    "thickness_measure",
    "The thickness of the bone straight through a point, or of the first bone behind it.",
    {
        {required, "at", id(), "A point.", "midline"},
        {required, "along", id(), "An axis or line, of which only the direction counts.", "right_pedicle"},
    }};

const Shape surface_measure{"surface_measure",
                            "The distance of a point to the bone's surface, negative inside.",
                            {
                                {required, "of", id(), "A point.", "midline"},
                            }};

const Shape roughness_measure{
    "roughness_measure",
    "The unevenness of a border: the root mean square distance of its outline from a smooth curve.",
    {
        {required, "of", id(), "A tangent of `constructions`, which says where the border is.", "right_pedicle"},
    }};

const Shape difference_measure{
    "difference_measure",
    "How much larger one measure is than another, such as the planned one.",
    {
        {required, "of", id(), "A measure above this one.", "wall"},
        {required, "from", id(), "Another one, which is subtracted: two angles, or two lengths.", "planned_wall"},
    }};

const Shape measure{"measure",
                    "A number that is measured before the first cut and when each step has ended.",
                    {
                        {one_of, "thickness", map(thickness_measure),
                         "The thickness of the bone at a point, along an axis.", "{at: midline, along: right_pedicle}"},
                        {one_of, "distance", map(distance_measure), "The distance between points, lines and planes.",
                         "{of: midline, to: resection}"},
                        {one_of, "surface_distance", map(surface_measure),
                         "The distance of a point to the bone's surface.", "{of: midline}"},
                        {one_of, "roughness", map(roughness_measure),
                         "The unevenness of the border that a tangent touches.", "{of: right_pedicle}"},
                        {one_of, "angle", map(angle_measure), "The angle between lines and planes.",
                         "{of: right_pedicle, to: resection}"},
                        {one_of, "difference", map(difference_measure), "How much larger one measure is than another.",
                         "{of: wall, from: planned_wall}"},
                    }};

const Shape procedure{
    "procedure",
    "An operation, in terms of an anatomy's names.",
    {
        {required, "apiVersion", word({"kerf/v1"}), api_version_help, "kerf/v1"},
        {required, "kind", word({"Procedure"}), "What this document describes.", "Procedure"},
        {required, "metadata", map(metadata), "Its name and status.",
         "{id: hole, title: A hole, version: 0.1.0, status: draft}"},
        {required, "needs", map(needs), "What the anatomy must have.",
         "{landmarks: [right_pedicle, midline, other_end], zones: [canal]}"},
        {required, "anatomy", path(),
         "The anatomy that it runs on without `--anatomy`: a file in this document's folder, or a shipped one.",
         "anatomy/vertebra-phantom.yaml"},
        {optional, "accuracy", map(accuracy), "The accuracy that the simulation needs.", "{spacing: 0.25 mm}"},
        {optional, "budget", map(budget), "The processor time that the simulation may use.", "{tick: 300 us}"},
        {required, "haptics", map(haptics), "The haptic device.", "{device: touch}"},
        {optional, "time_limit", quantity(dimension::time, "s", 1.0_s, 3600.0_s),
         "The simulated time after which the run ends.", "120 s", "120 s"},
        {required, "instruments", named(map(instrument)), "The tools, under names that steps use.",
         "{pilot: {plugin: example.drilling, tool: twist_drill, force: drill_cutting}}"},
        {optional, "implants", named(map(implant)), "Solids that waypoints bring in.",
         "{plate: {mesh: {file: plate.stl, unit: mm}}}"},
        {optional, "constructions", named(map(construction)),
         "Points, lines and planes that measures use, made of landmarks and of the bone.",
         "{way: {line: [midline, other_end]}}"},
        {optional, "measures", named(map(measure)),
         "Numbers that are measured on the bone, for results, goals and limits.",
         "{cortex: {thickness: {at: midline, along: right_pedicle}}}"},
        {required, "steps", list(map(step)), "What to do, in this order.",
         "[{id: drill, title: Drill, instrument: pilot, axis: right_pedicle, goals: [{entry: {}}]}]"},
        {optional, "paths", named(list(map(waypoint))), "Waypoints that several rehearsals follow.",
         "{approach: [{depth: -5 mm}, {depth: 5 mm}]}"},
        {optional, "rehearsals", list(map(rehearsal)), "Simulated hands, and their expected results.",
         "[{id: expert, expect: pass, path: [{depth: -5 mm}, {depth: 32 mm}]}]"},
        {optional, "variants", named(map(variant)), "The same with a few values changed, for `--variant`.",
         "{coarse: {patch: {accuracy.spacing: 0.5 mm}}}"},
    }};

// ---- anatomies
// -------------------------------------------------------------------------------------------------------

const Shape anatomy_metadata{"anatomy_metadata",
                             "What the anatomy is called.",
                             {
                                 {required, "id", id(), "The name that results use.", "vertebra-phantom"},
                                 {required, "title", text(), "The name that people read.", "Third lumbar vertebra"},
                             }};

const Shape box{"box",
                "A box along the patient's axes.",
                {
                    {required, "centre", position(), "Its centre.", "0 0 0 mm"},
                    {required, "size", vector(dimension::length, "mm", 0.1_mm, 2.0_m),
                     "Its whole edges along x, y and z.", "44 35 28 mm"},
                }};

const Shape tube{"tube",
                 "A round rod, cut flat.",
                 {
                     {required, "from", position(), "The middle of one end.", "0 26 -30 mm"},
                     {required, "to", position(), "The middle of the other.", "0 26 30 mm"},
                     {required, "radius", extent(), "From its axis to its wall.", "8 mm"},
                 }};

const Shape elliptic_tube{"elliptic_tube",
                          "A rod with an elliptic section, cut flat.",
                          {
                              {required, "from", position(), "The middle of one end.", "-20 34 5 mm"},
                              {required, "to", position(), "The middle of the other.", "-14 12 5 mm"},
                              {required, "width", extent(), "The whole section across `up`.", "10.3 mm"},
                              {required, "height", extent(), "The whole section along `up`.", "14.9 mm"},
                              {optional, "up", vector(dimension::none, "", -1.0, 1.0),
                               "The direction in which `height` is measured; towards the head if not given.", "0 0 1"},
                          }};

const Shape sphere{"sphere",
                   "A ball.",
                   {
                       {required, "centre", position(), "Its centre.", "0 0 0 mm"},
                       {required, "radius", extent(), "From its centre to its surface.", "23 mm"},
                   }};

const Shape tissue_solid{
    "tissue_solid",
    "One solid of a tissue.",
    {
        {one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
        {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
        {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
         "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
        {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"},
    }};

const Shape zone_solid{
    "zone_solid",
    "One solid of a zone.",
    {
        {one_of, "tissue", id(), "All solids of a tissue, as of the roots of teeth.", "root"},
        {one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
        {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
        {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
         "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
        {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"},
    }};

const Shape part{"part",
                 "A solid that is added to the bone, or taken away from the parts before it.",
                 {
                     {required, "id", id(), "Its name.", "body"},
                     {one_of, "box", map(box), "A box.", "{centre: 0 0 0 mm, size: 44 35 28 mm}"},
                     {one_of, "tube", map(tube), "A round rod.", "{from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}"},
                     {one_of, "elliptic_tube", map(elliptic_tube), "A rod with an elliptic section.",
                      "{from: -20 34 5 mm, to: -14 12 5 mm, width: 10 mm, height: 15 mm}"},
                     {one_of, "sphere", map(sphere), "A ball.", "{centre: 0 0 0 mm, radius: 23 mm}"},
                     {optional, "source", text(), "The source of its figures.", "Panjabi 1992."},
                     {optional, "subtract", yes_no(), "Taken away instead of added.", "true"},
                 }};

const Shape phantom{"phantom",
                    "Bone out of solids.",
                    {
                        {required, "parts", list(map(part)), "Added and taken away in this order.",
                         "[{id: body, box: {centre: 0 0 0 mm, size: 44 35 28 mm}}]"},
                    }};

const Shape labels{"labels",
                   "Which voxels are this bone, by a label map or a segmentation.",
                   {
                       {required, "file", path(), "In this document's folder or in KERF_DATA.", "scans/labels.nrrd"},
                       {required, "keep", list(label()),
                        "What is this bone: numbers, or the names that a segmentation of 3D Slicer gives.", "[22]"},
                   }};

const Shape kept_piece{"kept_piece",
                       "Which piece of what is bright, or has the labels, is this bone.",
                       {
                           {required, "component_at", id(), "A landmark point in it or beside it.", "body_centre"},
                       }};

const Shape density_line{
    "density_line",
    "Density of the last tissue out of a voxel's value: at_zero + per_unit × value.",
    {
        {required, "at_zero", density(-3.0_g_per_cm3, 3.0_g_per_cm3), "Where the value is 0.", "-0.1 g/cm3"},
        {required, "per_unit", density(-3.0_g_per_cm3, 3.0_g_per_cm3), "For each HU or grey level.", "0.001 g/cm3"},
        {required, "floor", density(0.01_g_per_cm3, 3.0_g_per_cm3), "Never less than this.", "0.1 g/cm3"},
        {required, "source", text(), "The source of this line.", "Rho et al. 1995."},
    }};

const Shape ct{
    "ct",
    "Bone out of a CT.",
    {
        {required, "image", path(),
         "A file, or a folder with a DICOM series; in this document's folder or in KERF_DATA.", "scans/bone.nii.gz"},
        {optional, "series", text(),
         "Which series of the folder, as `kerf import` offers them; needed if there are several.", "4"},
        {optional, "acquisition", text(),
         "Which acquisition of the series, as `kerf import` offers them; needed if several show the same part.", "1"},
        {optional, "resample", yes_no(), "Gaps between slices may be filled from their neighbours.", "true"},
        {optional, "intensity", word({"HU", "grey"}),
         "What the values are: HU if not given; grey levels of a cone-beam CT are none.", "grey"},
        {optional, "labels", map(labels), "Which voxels are this bone; those above the threshold if not given.",
         "{file: scans/labels.nrrd, keep: [22]}"},
        {optional, "keep", map(kept_piece), "Which piece is this bone; without labels the largest if not given.",
         "{component_at: body_centre}"},
        {required, "threshold", number(-4000.0, 65535.0), "The value at the border of bone, in HU or grey levels.",
         "150"},
        {optional, "closing", length(0.0_mm, 10.0_mm), "Narrower gaps in the mask are closed: a radius.", "2 mm"},
        {optional, "fill", yes_no(), "Cavities without a way out count as bone.", "true"},
        {optional, "density", map(density_line), "Density of the last tissue, voxel by voxel.",
         "{at_zero: -0.1 g/cm3, per_unit: 0.001 g/cm3, floor: 0.1 g/cm3, source: A book.}"},
        {optional, "source", text(), "The source of the scan.", "A public collection."},
    }};

const Shape repair{
    "repair",
    "Repairs of a surface beyond those that are always safe.",
    {
        {optional, "holes_up_to", length(0.0_mm, 20.0_mm), "Holes no wider than this are closed.", "3 mm"},
        {optional, "pieces_under", quantity(dimension::volume, "mm3", 0.0, 1e-6), "Smaller pieces are left out.",
         "10 mm3"},
        {optional, "inner", word({"hollow", "solid"}),
         "The meaning of surfaces inside the outer one: cavities, or marks in solid bone.", "hollow"},
    }};

const Shape canal{"canal",
                  "The marrow cavity: it holds no bone.",
                  {
                      {one_of, "file", path(), "A second surface, in the same unit and frame.", "meshes/canal.stl"},
                      {one_of, "tube", map(tube), "A round rod.", "{from: 0 0 -100 mm, to: 0 0 100 mm, radius: 6 mm}"},
                  }};

const Shape mesh{
    "mesh",
    "Bone out of a closed surface.",
    {
        {required, "file", path(), "STL, OBJ or PLY, in this document's folder or in KERF_DATA.", "meshes/femur.stl"},
        {required, "unit", word({"mm", "cm", "m", "um"}), "The length of 1 in the file: the formats do not store it.",
         "mm"},
        {optional, "frame", word({"LPS", "RAS"}),
         "The direction of its axes; LPS is assumed, and reported, if not given.", "LPS"},
        {optional, "repair", map(repair), "Repairs that are allowed.", "{holes_up_to: 3 mm}"},
        {optional, "canal", map(canal), "The marrow cavity.",
         "{tube: {from: 0 0 -100 mm, to: 0 0 100 mm, radius: 6 mm}}"},
        {optional, "source", text(), "The source of the surface.", "A public collection."},
    }};

const Shape tissue{"tissue",
                   "The tissues of bone: shells from the surface inwards, or solids. The first one has precedence, the "
                   "last one fills the "
                   "rest.",
                   {
                       {required, "id", id(), "Its name.", "cortical"},
                       {optional, "thickness", length(0.1_mm, 20.0_mm),
                        "Of the shell. The last tissue has none; all others need it, or `solids`.", "1.5 mm"},
                       {optional, "solids", list(map(tissue_solid)),
                        "Where it is: their union, and of that the shell if there is a `thickness`. Not of the last.",
                        "[{tube: {from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}}]"},
                       {optional, "density", density(0.05_g_per_cm3, 3.0_g_per_cm3),
                        "Needed, unless `ct.density` gives it to the last tissue.", "1.85 g/cm3"},
                       {optional, "source", text(), "The source of its figures.", "Silva et al. 1994."},
                   }};

const Shape fit_residual{"fit_residual",
                         "How well the bone must have the shape that is fitted.",
                         {
                             {required, "at_most", length(0.01_mm, 20.0_mm),
                              "The root mean square of the distances from the shape.", "1 mm"},
                         }};

const Shape sphere_fit{"sphere_fit",
                       "A sphere on the surface, such as the head of a femur.",
                       {
                           {required, "radius", fitted_radius(), "About its radius: within 30 %.", "23 mm"},
                           {optional, "within", fitted_within(),
                            "How far its centre may be from the position that is written.", "12 mm", "15 mm"},
                       }};

const Shape tube_fit{"tube_fit",
                     "A round stretch of bone between `from` and `to`, such as a shaft: the axis is its own.",
                     {
                         {required, "radius", fitted_radius(), "About its radius: within 30 %.", "14 mm"},
                         {optional, "within", fitted_within(),
                          "How far its axis may be from the ends that are written.", "12 mm", "15 mm"},
                     }};

const Shape neck_fit{"neck_fit",
                     "A neck: the axis passes through the centre of its head and the middle of its narrowest part.",
                     {
                         {required, "head", id(), "A point that is fitted to a sphere.", "head"},
                         {optional, "within", fitted_within(),
                          "How far the axis may be from the ends that are written.", "12 mm", "15 mm"},
                     }};

const Shape condyles_fit{
    "condyles_fit",
    "The posterior condylar line: a plane parallel to the shaft touches both condyles from behind.",
    {
        {required, "shaft", id(), "An axis along the bone.", "shaft"},
        {optional, "within", fitted_within(), "How far the line may be from the ends that are written.", "12 mm",
         "15 mm"},
    }};

const Shape point_fit{
    "point_fit",
    "What the point is of the bone: import finds it near `at`.",
    {
        {one_of, "sphere", map(sphere_fit), "The centre of a sphere.", "{radius: 23 mm, within: 12 mm}"},
        {optional, "residual", map(fit_residual), "How well the sphere must fit: the tolerance if not given.",
         "{at_most: 1 mm}"},
    }};

const Shape axis_fit{
    "axis_fit",
    "What the axis is of the bone: import finds it near `from` and `to`.",
    {
        {one_of, "tube", map(tube_fit), "The axis of a round stretch of bone.", "{radius: 14 mm, within: 12 mm}"},
        {one_of, "neck", map(neck_fit), "Through the centre of a head and along its neck.", "{head: head}"},
        {one_of, "condyles", map(condyles_fit), "Along the backs of two condyles, one at `from` and one at `to`.",
         "{shaft: shaft}"},
        {optional, "residual", map(fit_residual), "How well the shape must fit: the tolerance if not given.",
         "{at_most: 1 mm}"},
    }};

const Shape point{"point",
                  "A point.",
                  {
                      {required, "at", position(),
                       "Where it is: LPS, x to the patient's left, y to the back, z to the head.", "0 26 5 mm"},
                      {required, "tolerance", tolerance(), "The uncertainty of its position.", "1.5 mm"},
                      {optional, "lies", word({"on_bone", "in_bone", "off_bone"}),
                       "Its relation to the bone, which import checks within the tolerance.", "on_bone"},
                      {optional, "fit", map(point_fit), "How import finds it from the bone, near `at`.",
                       "{sphere: {radius: 23 mm, within: 12 mm}}"},
                  }};

const Shape axis{"axis",
                 "An axis into the bone.",
                 {
                     {required, "from", position(), "Where it begins, outside the bone.", "-23.5 47 5 mm"},
                     {required, "to", position(), "Where it ends, inside the bone.", "-9.9 -6 5 mm"},
                     {required, "tolerance", tolerance(), "The uncertainty of its position.", "1.5 mm"},
                     {optional, "fit", map(axis_fit), "How import finds it from the bone, near `from` and `to`.",
                      "{tube: {radius: 14 mm, within: 12 mm}}"},
                 }};

const Shape plane{
    "plane",
    "A flat cut, or a face.",
    {
        {required, "at", position(), "A point in it.", "0 0 120 mm"},
        {required, "normal", vector(dimension::none, "", -1.0, 1.0), "The direction of its normal.", "0 0 1"},
        {required, "tolerance", tolerance(), "The uncertainty of its position.", "1.5 mm"},
    }};

const Shape markup_name{"markup_name",
                        "What a markup is called here.",
                        {
                            {required, "label", text(), "What the file calls it.", "F-1"},
                            {required, "id", id(), "The landmark that it is.", "entry"},
                        }};

const Shape markups{
    "markups",
    "Landmarks that 3D Slicer wrote: points, lines as axes, planes.",
    {
        {required, "file", path(), "`.mrk.json` or `.fcsv`, in this document's folder or in KERF_DATA.",
         "scans/entry.mrk.json"},
        {required, "tolerance", tolerance(), "The uncertainty of all of them.", "2 mm"},
        {optional, "names", list(map(markup_name)), "Other names than the file's.", "[{label: F-1, id: entry}]"},
    }};

const Shape landmarks{
    "landmarks",
    "Named positions that procedures use.",
    {
        {optional, "points", named(map(point)), "Points.", "{head: {at: 0 26 5 mm, tolerance: 1.5 mm}}"},
        {optional, "axes", named(map(axis)), "Axes into the bone.",
         "{right_pedicle: {from: -23.5 47 5 mm, to: -9.9 -6 5 mm, tolerance: 1.5 mm}}"},
        {optional, "planes", named(map(plane)), "Flat cuts.",
         "{resection: {at: 0 0 120 mm, normal: 0 0 1, tolerance: 1.5 mm}}"},
        {optional, "markups", list(map(markups)), "Files of 3D Slicer's markups.",
         "[{file: scans/entry.mrk.json, tolerance: 2 mm}]"},
    }};

const Shape fracture_turn{
    "fracture_turn",
    "How a fragment is turned about the fracture's `at`.",
    {
        {required, "by", quantity(dimension::angle, "deg", -180.0_deg, 180.0_deg), "The angle.", "12 deg"},
        {required, "about", vector(dimension::none, "", -1.0, 1.0), "The direction of the axis.", "0 1 0"},
    }};

const Shape fracture{
    "fracture",
    "A flat break through the bone. Landmarks and zones are those of the whole bone.",
    {
        {required, "at", position(), "A point of the break.", "0 0 120 mm"},
        {required, "normal", vector(dimension::none, "", -1.0, 1.0),
         "The direction of its normal, into the fragment that has moved.", "0 0 1"},
        {optional, "gap", length(0.1_mm, 20.0_mm), "The bone that is lost between the parts.", "0.5 mm", "0.5 mm"},
        {optional, "shift", vector(dimension::length, "mm", -200.0_mm, 200.0_mm),
         "How far the fragment has moved (LPS).", "5 -3 8 mm"},
        {optional, "turn", map(fracture_turn), "How the fragment has turned.", "{by: 12 deg, about: 0 1 0}"},
    }};

const Shape anatomy{
    "anatomy",
    "Bone, tissues, and named positions.",
    {
        {required, "apiVersion", word({"kerf/v1"}), api_version_help, "kerf/v1"},
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
         "{canal: [{tube: {from: 0 26 -30 mm, to: 0 26 30 mm, radius: 8 mm}}]}"},
    }};

}  // namespace kerf::shapes
