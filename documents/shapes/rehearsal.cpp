// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

ValueOf<double> driver_torque() { return quantity(dimension::torque, "N*m", 0.05, 20.0); }

}  // namespace

const MapShape<Rehearsal> expectation{
    "expectation",
    "The expected failure.",
    {{required, "fail", id(), "The one limit that breaks: its zone, event, signal or measure, or else its quantity.",
      "canal"},
     {optional, "step", id(), "The one step in which it breaks; any step if not given.", "drill"},
     {optional, "others", &Rehearsal::expects_others, yes_no(), "Other limits may break as well, and goals be missed.",
      "true", "false"}}};

const MapShape<Rehearsal> hand{
    "hand",
    "The properties of the simulated hand.",
    {{optional, "feed", &Rehearsal::feed, speed(), "The speed that it aims at in bone.", "1 mm/s", "1 mm/s"},
     {optional, "approach", &Rehearsal::approach, speed(), "Its speed in air.", "10 mm/s", "10 mm/s"},
     {optional, "push", &Rehearsal::push, quantity(dimension::force, "N", 0.1_N, hardest_push),
      "Its largest push, at the bone.", "60 N", "60 N"},
     {optional, "reaction", &Rehearsal::reaction, quantity(dimension::time, "ms", 0.0_ms, 2000.0_ms),
      "Its reaction time.", "150 ms", "150 ms"}}};

const MapShape<Waypoint> stop{"stop",
                              "What makes the hand give up its way and go to the last waypoint.",
                              {{required, "aside", &Waypoint::skip_distance, length(0.1_mm, 100.0_mm),
                                "The tip is so far beside the way.", "1 mm"}}};

const MapShape<Waypoint> until{
    "until",
    "What ends the turn early. The hand feels it one reaction late.",
    {{one_of, "torque", &Waypoint::until_torque, driver_torque(),
      "The hand feels this torque of the bone against the turn.", "2 N*m"},
     {one_of, "event", &Waypoint::until_event, id(),
      "The force of the step's instrument reports this event, such as that the head seats.", "drilling.stalled"}}};

const MapShape<Waypoint> turn{
    "turn",
    "How the hand turns the tool about its axis.",
    {{required, "by", &Waypoint::turn, quantity(dimension::angle, "turns", -1000.0_turns, 1000.0_turns),
      "Clockwise as the hand sees it, which drives a screw in; negative: back.", "18 turns"},
     {optional, "speed", &Waypoint::turning, quantity(dimension::frequency, "rpm", 0.1_rpm, 300.0_rpm),
      "The speed of the turn.", "30 rpm", "30 rpm"},
     {optional, "torque", &Waypoint::turn_torque, driver_torque(),
      "The largest torque of the bone against which the hand turns on; if not given, it turns until the "
      "driver slips in it, at 5 N*m in one hand.",
      "3 N*m"},
     {optional, "until", map(until), "What ends the turn early; `by` is then the most.", "{torque: 2 N*m}"},
     {optional, "regrip", &Waypoint::regrip, angle(45.0_deg, 360.0_deg),
      "After each such angle the hand lets the driver go, turns back and takes hold again.", "180 deg"}}};

const MapShape<Waypoint> waypoint{
    "waypoint",
    "A position of the tool in the frame of a step's axis.",
    {{optional, "step", id(), "The step whose frame holds from here on; the first step until one is named.", "drill"},
     {required, "depth", &Waypoint::depth, depth(), "From the point where the axis meets bone; negative outside.",
      "32 mm"},
     {optional, "medial", &Waypoint::medial, length(-100.0_mm, 100.0_mm), "Sideways, towards the landmark `midline`.",
      "5 mm"},
     {optional, "medial_angle", &Waypoint::medial_angle, angle(-60.0_deg, 60.0_deg),
      "The angle of the whole approach from the axis towards the landmark `midline`, about the point where the axis "
      "meets bone.",
      "20 deg"},
     {optional, "cranial_angle", &Waypoint::cranial_angle, angle(-60.0_deg, 60.0_deg),
      "The same from the axis towards the patient's head.", "10 deg"},
     {optional, "direction", &Waypoint::is_across_surface, choice<bool>({{"axis", false}, {"surface", true}}),
      "`surface`: depth and tool point straight into the bone's surface where the axis meets it, as for a starting "
      "hole.",
      "surface", "axis"},
     {optional, "aside", &Waypoint::aside, length(-100.0_mm, 100.0_mm),
      "Sideways in the step's plane, along the tool's x.", "2 mm"},
     {optional, "tilt", &Waypoint::tilt, angle(-90.0_deg, 90.0_deg),
      "The rotation of the blade about the axis, out of the step's plane.", "6 deg"},
     {optional, "displaced", &Waypoint::is_displaced, yes_no(),
      "Where the anatomy's fracture has moved it to, and not where it is in the whole bone.", "true", "false"},
     {optional, "speed", &Waypoint::speed, speed(),
      "The speed that the hand aims at on its way here; if not given, its own.", "0.5 mm/s"},
     {optional, "push", &Waypoint::push, quantity(dimension::force, "N", 0.1_N, hardest_push),
      "Its largest push on the way here, at the bone; if not given, its own.", "20 N"},
     {optional, "stop", part_of(stop), "What makes the hand give up on the way here.", "{aside: 1 mm}"},
     {optional, "turn", map(turn),
      "The rotation of the tool on the way here, as of a screw. It sets the time of the way.", "{by: 18 turns}"},
     {optional, "drives", of_kind(Kind::drives), "The drives of the step's tool, set on arrival.",
      "{spindle_speed: 500 rpm}"},
     {optional, "insert", id(), "One of `implants`, which is inserted on arrival, at the tool.", "plate"},
     {optional, "place", id(), "One of `implants`, which is inserted on arrival, at its planned pose.", "plate"},
     {optional, "do", word({"undo", "redo", "remove", "fuse", "subtract", "release", "image", "assist"}),
      "On arrival: undo or redo the last change of the bone, remove the held piece from the scene, fuse it with the "
      "piece next to it, subtract the tool's cutting region from the bone, release an implant where it is, take an AP "
      "radiograph, or request help with the step.",
      "undo"}}};

const Shape follow{
    "follow", "The waypoints of a path, at this place.", {{required, "follow", id(), "One of `paths`.", "approach"}}};

const MapShape<Rehearsal> rehearsal{
    "rehearsal",
    "The path of a simulated hand, and its expected result.",
    {{required, "id", &Rehearsal::id, id(), "Its name, for `--hand`.", "expert"},
     {optional, "title", &Rehearsal::title, words(), "What it shows.", "Along the planned axis"},
     {required, "expect", word_or({"pass", "incomplete"}, expectation),
      "`pass`, `incomplete` for goals that are not reached, or the limit that breaks.", "{fail: canal}"},
     {optional, "hand", part_of(hand, "hand"), "The properties of the simulated hand.", "{feed: 1 mm/s, push: 60 N}"},
     {required, "path", list(map_or(waypoint, follow)),
      "The waypoints, at least two; `{follow: NAME}` has the waypoints of one of `paths`.",
      "[{depth: -5 mm}, {depth: 32 mm}]"}}};

}  // namespace kerf::documents::shapes
