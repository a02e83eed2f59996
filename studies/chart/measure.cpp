// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/measure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kerf/units.hpp"
#include "studies/chart/reference.h"
#include "studies/chart/replay.h"
#include "studies/times.h"

namespace kerf::chart {

using namespace literals;

namespace {

/// Shifts of the grid in parts of a voxel: any that have nothing to do with each other.
constexpr Vec3 shifts[] = {{0.31, 0.17, 0.73}, {0.87, 0.59, 0.13}, {0.05, 0.91, 0.47}, {0.63, 0.37, 0.89}};

}  // namespace

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

/// What one run felt, tick by tick, and what it should have felt.
struct Track {
    std::vector<Felt> felt;
    std::vector<Vec3> reference;  ///< [N] tool frame
    std::vector<bool> is_compared;
    double volume = 0.0, volume_reference = 0.0;  ///< [m³]
};

Track run_through(const Method& method, const Scene& scene, const CuttingLaw& law, const Fineness& fineness,
                  double gain) {
    const auto run = method.start(scene, fineness, gain);
    ExactForce exact(scene, law);
    Track track;
    for (std::size_t t = 0; t < scene.ticks(); ++t) {
        const Felt& felt = track.felt.emplace_back(run->tick(scene.pose_at(scene.depth[t + 1])));
        const double turned = std::max(0.0, static_cast<double>(t) - method.first_lag);
        track.reference.push_back(linear(exact.wrench(felt.from, felt.rate, 2.0 * pi * scene.spindle * dt * turned)));
        track.is_compared.push_back(exact.is_within_relief());
    }
    track.volume_reference = exact_volume(scene, exact.deepest());
    track.volume = run->removed_volume();
    return track;
}

/// Where a drill that finds its own motion walks, the exact law of a straight way says nothing: its motion is replayed.
void refer_to_replay(const Method& method, const Scene& scene, Track& track) {
    const Replayed replayed = replay(method, scene, track.felt);
    for (std::size_t t = 0; t < track.felt.size(); ++t) track.reference[t] = {0, 0, replayed.axial[t]};
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
    Measured measured;
    measured.gain = calibration(method, scene, law, fineness);
    double all_wrong = 0.0, all_right = 0.0, ticks = 0.0;
    std::vector<double> costs;
    for (int g = 0; g < grids; ++g) {
        Fineness shifted = fineness;
        shifted.offset = shifts[g % 4];
        Track track = run_through(method, scene, law, shifted, measured.gain);
        if (walks(method, scene)) refer_to_replay(method, scene, track);
        hold_against(led, track.felt, scene, measured);
        double wrong = 0.0, right = 0.0, largest = 0.0, step = 0.0;
        Vec3 last_difference{0, 0, 0};
        bool has_last = false;
        for (std::size_t t = 0; t < track.felt.size(); ++t) {
            costs.push_back(track.felt[t].cost);
            Vec3 force = linear(track.felt[t].wrench), reference = track.reference[t];
            measured.is_finite = measured.is_finite && is_finite(force);
            if (!is_finite(force) || !track.is_compared[t]) {
                has_last = false;
                continue;
            }
            if (walks(method, scene))  // a replay tells the thrust alone
                force = {0, 0, force.z};
            else if (std::hypot(reference.x, reference.y) < 1.0)
                measured.off_lateral = std::max(measured.off_lateral, std::hypot(force.x, force.y));
            const Vec3 difference = force - reference;
            wrong += dot(difference, difference);
            right += dot(reference, reference);
            largest = std::max(largest, length(reference));
            if (has_last) step = std::max(step, length(difference - last_difference));
            last_difference = difference;
            has_last = true;
            ticks += 1.0;
        }
        all_wrong += wrong;
        all_right += right;
        measured.worst_grid = std::max(measured.worst_grid, std::sqrt(wrong / right));
        measured.peak_step = std::max(measured.peak_step, step / largest);
        measured.volume_error += std::abs(track.volume - track.volume_reference) / track.volume_reference / grids;
    }
    measured.force_error = std::sqrt(all_wrong / all_right);
    measured.reference = std::sqrt(all_right / ticks);
    const Times times = times_of(std::move(costs));
    measured.cost = {times.median, times.p999, times.longest};
    return measured;
}

}  // namespace kerf::chart
