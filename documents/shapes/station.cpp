// SPDX-License-Identifier: Apache-2.0
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

ChoiceOf<Vec3> side() { return choice<Vec3>(sides); }

}  // namespace

const MapShape<DeviceStation> device_axes{
    "device_axes",
    "The directions of the patient in which the axes of the device lead.",
    {{required, "right", &DeviceStation::right, side(), "The device's +x, to the user's right.", "right"},
     {required, "up", &DeviceStation::up, side(), "The device's +y.", "superior"}}};

const MapShape<Box> workspace{
    "workspace",
    "The box that the handle reaches, in the frame of the device.",
    {{required, "from", &Box::low, position(), "Its corner with the smallest coordinates.", "-80 -60 -40 mm"},
     {required, "to", &Box::high, position(), "Its corner with the largest coordinates.", "80 60 40 mm"}}};

const MapShape<HandleFit> handle_fit{
    "handle_fit",
    "What was fixed to the handle of the device.",
    {{optional, "grip", &HandleFit::grip, vector(dimension::length, "mm", -0.3_m, 0.3_m),
      "Where the hand grips, in the frame of the handle.", "0 0 0 mm", "0 0 40 mm"},
     {optional, "mass", &HandleFit::mass, quantity(dimension::mass, "g", 0.0, 1.0),
      "Mass that was fixed at the grip, and that the device carries.", "0 g", "60 g"}}};

const MapShape<DeviceStation> station_device{
    "station_device",
    "The setup of one device.",
    {{required, "device", &DeviceStation::device, text(), "The device as `kerf devices` shows it, or its driver.",
      "udp"},
     {optional, "axes", part_of(device_axes), "The axes of the device as directions of the patient.",
      "{right: right, up: superior}"},
     {optional, "scale", &DeviceStation::scale, number(min_scale, 1.0),
      "Motion of the tool per motion of the handle. A larger one would make the device stiffer than it can be.", "1",
      "1"},
     {optional, "workspace", &DeviceStation::workspace, map(workspace),
      "The box that the handle reaches. The scale is then computed, so that the operation fits into it.",
      "{from: -80 -60 -40 mm, to: 80 60 40 mm}"},
     {optional, "handle", &DeviceStation::handle, map(handle_fit), "What was fixed to the handle of the device.",
      "{grip: 0 0 40 mm, mass: 60 g}"},
     {optional, "speed", &DeviceStation::speed, quantity(dimension::speed, "mm/s", 1.0_mm_per_s, 200.0_mm_per_s),
      "Speed of the aim at full deflection, times `scale`. Only of a device without position.", "20 mm/s", "20 mm/s"},
     {optional, "turn_speed", &DeviceStation::turn_speed, turn_speed(),
      "Speed of the aim's turn at full deflection, times `scale`. A wrist turns at most 1 rad/s.", "30 deg/s",
      "30 deg/s"},
     {optional, "dead_zone", &DeviceStation::dead_zone, number(0.0, 0.5),
      "Deflection that counts as rest, as a fraction of the full one.", "0.1", "0.1"},
     {optional, "buttons", list(word({"none", "drive", "next", "clutch", "undo"})), "The action of each button.",
      "[drive, next, clutch, undo]", "[drive, next, clutch, undo]"},
     {optional, "pedal", &DeviceStation::pedal, text(), "A second device, whose buttons do what its own entry states.",
      "pedal"},
     {optional, "knob", &DeviceStation::knob, text(),
      "A second device, a knob, whose turn adds to that of the handle, and which makes the torque about the shaft.",
      "my_knob"},
     {optional, "peer", text(), "The address of another machine whose program drives the device.", "192.168.1.7"},
     {optional, "key_file", text(), "The file of the key that both machines share.", "/home/user/kerf.key"},
     {optional, "motion", text(), "The file of a motion that the device plays.", "/home/user/motion.csv"},
     {optional, "settings", named(text()),
      "Of the driver: its parameters, as `kerf describe` lists them, and its texts.", "{port: 10001}"}}};

const Shape station{"station",
                    "The devices of one table.",
                    {{required, "apiVersion", word({"kerf/v1"}), api_version_help, "kerf/v1"},
                     {required, "kind", word({"Station"}), "What this document describes.", "Station"},
                     {required, "devices", list(map(station_device)), "Their setups.", "[{device: udp, scale: 1}]"}}};

}  // namespace kerf::documents::shapes
