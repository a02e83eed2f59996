// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/chart/measure.h"

#include <algorithm>
#include <cmath>

#include "conformance/chart/reference.h"
#include "conformance/chart/times.h"
#include "kerf/units.hpp"

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
    const double right = -edge_wrench(scene.drill, law, wholly_engaged(scene.drill), 0.0, scene.feed / (2.0 * scene.spindle))[2];
    return std::abs(sum) > 1e-12 * count ? right * count / sum : 1.0;
}

Measured measure(const Method& method, const Scene& scene, const CuttingLaw& law, const Fineness& fineness, int grids) {
    Measured measured;
    measured.gain = calibration(method, scene, law, fineness);
    double all_wrong = 0.0, all_right = 0.0, ticks = 0.0;
    std::vector<double> costs;
    for (int g = 0; g < grids; ++g) {
        Fineness shifted = fineness;
        shifted.offset = shifts[g % 4];
        const auto run = method.start(scene, shifted, measured.gain);
        ExactForce exact(scene, law);
        double wrong = 0.0, right = 0.0, largest = 0.0, step = 0.0;
        Vec3 last_difference{0, 0, 0};
        bool has_last = false;
        for (std::size_t t = 0; t < scene.ticks(); ++t) {
            const Felt felt = run->tick(scene.pose_at(scene.depth[t + 1]));
            costs.push_back(felt.cost);
            const double turned = std::max(0.0, static_cast<double>(t) - method.first_lag);
            const Vec3 reference = linear(exact.wrench(felt.from, felt.rate, 2.0 * pi * scene.spindle * dt * turned));
            if (!is_finite(linear(felt.wrench))) {
                measured.is_finite = false;
                continue;
            }
            if (!exact.is_within_relief()) {
                has_last = false;
                continue;
            }
            Vec3 difference = linear(felt.wrench) - reference;
            if (method.is_solved) difference = {0, 0, difference.z};
            else if (std::hypot(reference.x, reference.y) < 1.0)
                measured.off_lateral = std::max(measured.off_lateral, std::hypot(felt.wrench[0], felt.wrench[1]));
            wrong += dot(difference, difference);
            right += method.is_solved ? reference.z * reference.z : dot(reference, reference);
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
        const double volume = exact_volume(scene, exact.deepest());
        measured.volume_error += std::abs(run->removed_volume() - volume) / volume / grids;
    }
    measured.force_error = std::sqrt(all_wrong / all_right);
    measured.reference = std::sqrt(all_right / ticks);
    const Times times = of(std::move(costs));
    measured.cost = {times.median, times.p999, times.longest};
    return measured;
}

}  // namespace kerf::chart
