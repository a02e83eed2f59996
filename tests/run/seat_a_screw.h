// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "kerf/math.hpp"
#include "session/recording.h"

/// A screw that a hand turns into a bored block of bone.
namespace kerf::run {

inline const char* const bored_block = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: bored, title: A bored block of bone}
phantom:
  parts:
    - {id: block, box: {centre: 0 0 0 mm, size: 24 24 40 mm}}
    - {id: hole, tube: {from: 0 0 25 mm, to: 0 0 -8 mm, radius: 1.6 mm}, subtract: true}
tissues:
  - {id: bone, density: 0.3 g/cm3}
landmarks:
  axes: {way: {from: 0 0 30 mm, to: 0 0 -18 mm, tolerance: 1 mm}}
)";

// The axis meets bone at the bottom of the hole, 28 mm below the face.
inline const char* const seat_a_screw = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: seat, title: Seat a screw, version: 0.1.0, status: draft}
needs: {landmarks: [way], tissues: [bone]}
anatomy: bored.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: touch-driver, force_scale: 1/10}
time_limit: 60 s
instruments:
  screw:
    plugin: kerf.implant
    tool: pedicle_screw
    force: screw_insertion
    parameters: {outer_diameter: 6.5 mm, thread_length: 20 mm}
steps:
  - id: insert
    title: Insert the screw
    instrument: screw
    axis: way
    goals: [{depth: {at_least: 5 mm}}]
    limits: [{depth: {at_most: 20 mm}, reason: The screw is too deep.}]
rehearsals:
  - id: expert
    expect: incomplete
    hand: {push: 20 N}
    path: [{depth: -34 mm}, {depth: -27 mm}, {depth: -9 mm, turn: {TURN}, do: release}, {depth: -9 mm}]
)";

/// Writes the procedure and its anatomy into a folder. Returns the file of the procedure.
/// @param turn   of the expert: "by: 5 turns, speed: 60 rpm"
inline std::string write_seat_a_screw(const std::string& folder, const std::string& turn, const std::string& device) {
    std::string text = seat_a_screw;
    text.replace(text.find("TURN"), 4, turn);
    text.replace(text.find("touch-driver"), 12, device);
    std::ofstream(folder + "/bored.yaml") << bored_block;
    std::ofstream(folder + "/seat.yaml") << text;
    return folder + "/seat.yaml";
}

/// Returns how far a pose turned about its own z over the rows [rad], many turns.
inline double turned_by(const std::vector<session::TickRow>& ticks, Pose session::TickRow::*pose) {
    double sum = 0.0;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        sum += small_rotation_vector(conjugate((ticks[i - 1].*pose).rotation) * (ticks[i].*pose).rotation).z;
    return sum;
}

}  // namespace kerf::run
