// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/measure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/chart/drill/reference.h"
#include "studies/chart/drill/replay.h"

namespace kerf::chart {

using namespace literals;

Scene block_scene(const Scene& like, double depth) {
    Scene scene;
    scene.id = "block";
    scene.title = "Cortical block";
    scene.drill = like.drill;
    scene.spindle = like.spindle;
    scene.feed = like.feed;
    scene.bone.surface = [](Vec3 p) { return p.z; };
    scene.bone.tissues = {{"cortical", 1850.0, {}}};
    const double reach = scene.drill.radius() + 1.0_mm;
    scene.bone.low = {-reach, -reach, -depth - 2.0_mm};
    scene.bone.high = {reach, reach, 1.0_mm};
    scene.depth = {-0.2_mm};
    go_to(scene, depth, scene.feed);
    return scene;
}

double calibration(const Method& method, const Scene& like, const CuttingLaw& law, const Fineness& fineness) {
    if (!method.is_calibrated) return 1.0;
    const double whole = like.drill.point_depth();
    const Scene scene = block_scene(like, 2.2 * whole);
    const auto run = method.start(scene, fineness, 1.0);
    double sum = 0.0, count = 0.0;
    for (std::size_t t = 0; t < scene.ticks(); ++t) {
        const Felt felt = run->tick(scene.pose_at(scene.depth[t + 1]));
        if (scene.depth[t] < 1.2 * whole) continue;
        sum -= felt.wrench[2];
        count += 1.0;
    }
    const double right =
        -edge_wrench(scene.drill, law, wholly_engaged(scene.drill), 0.0, scene.feed / (2.0 * scene.spindle))[2];
    return std::abs(sum) > 1e-12 * count ? right * count / sum : 1.0;
}

namespace {

Track run_through(const Method& method, const Scene& scene, const CuttingLaw& law, const Fineness& fineness,
                  double gain) {
    const auto run = method.start(scene, fineness, gain);
    ExactForce exact(scene, law);
    Track track;
    for (std::size_t t = 0; t < scene.ticks(); ++t) {
        const Felt& felt = track.felt.emplace_back(run->tick(scene.pose_at(scene.depth[t + 1])));
        const double turned = std::max(0.0, static_cast<double>(t) - method.first_lag);
        track.reference.push_back(exact.wrench(felt.from, felt.rate[2], 2.0 * pi * scene.spindle * dt * turned));
        track.is_compared.push_back(exact.is_within_relief());
    }
    track.volume_reference = exact_volume(scene, exact.deepest());
    track.volume = run->removed_volume();
    return track;
}

/// Where a drill that finds its own motion walks, the exact law of a straight way says nothing: its motion is replayed.
void refer_to_replay(const Method& method, const Scene& scene, Track& track) {
    const Replayed replayed = replay(method, scene, track.felt);
    for (std::size_t t = 0; t < track.felt.size(); ++t) track.reference[t] = make_vec6({0, 0, replayed.axial[t]}, {});
    track.volume_reference = replayed.volume;
}

/// The largest so far of the RMS of their difference, of the RMS of what was led, both as means over so many ticks.
void hold_against(const std::vector<Felt>& led, const std::vector<Felt>& felt, std::size_t over, double& most) {
    double wrong = 0.0, right = 0.0, difference = 0.0, reference = 0.0;
    const auto add = [&](std::size_t t, double sign) {
        difference += sign * (felt[t].wrench[2] - led[t].wrench[2]);
        reference += sign * led[t].wrench[2];
    };
    for (std::size_t t = 0; t < std::min(led.size(), felt.size()); ++t) {
        add(t, 1.0);
        if (t + 1 < over) continue;
        wrong += difference * difference;
        right += reference * reference;
        add(t + 1 - over, -1.0);
    }
    if (right > 0.0) most = std::max(most, std::sqrt(wrong / right));
}
void hold_against(const std::vector<Felt>& led, const std::vector<Felt>& felt, const Scene& scene, Measured& measured) {
    hold_against(led, felt, 1, measured.same_hand);
    hold_against(led, felt, static_cast<std::size_t>(std::lround(1.0 / (scene.spindle * dt))), measured.same_hand_turn);
    for (std::size_t t = 0; t < std::min(led.size(), felt.size()); ++t)
        measured.apart = std::max(measured.apart, length(felt[t].from.position - led[t].from.position));
}

}  // namespace

std::vector<Felt> led_by_hand(const Method& method, const Scene& scene, const Fineness& fineness) {
    const auto run = method.start(scene, fineness, 1.0);
    std::vector<Felt> felt;
    for (std::size_t t = 0; t < scene.ticks(); ++t) felt.push_back(run->tick(scene.pose_at(scene.depth[t + 1])));
    return felt;
}

Measured measure(const Method& method, const Scene& scene, const CuttingLaw& law, const Fineness& fineness, int grids,
                 const std::vector<Felt>& led) {
    const double gain = calibration(method, scene, law, fineness);
    ErrorSum errors(walks(method, scene));
    Measured beside;  // what is compared with the same hand
    for (int g = 0; g < grids; ++g) {
        Fineness shifted = fineness;
        shifted.offset = grid_shift(g);
        Track track = run_through(method, scene, law, shifted, gain);
        if (walks(method, scene)) refer_to_replay(method, scene, track);
        hold_against(led, track.felt, scene, beside);
        errors.add(track);
    }
    Measured measured = errors.measured();
    measured.gain = gain;
    measured.same_hand = beside.same_hand;
    measured.same_hand_turn = beside.same_hand_turn;
    measured.apart = beside.apart;
    return measured;
}

}  // namespace kerf::chart
