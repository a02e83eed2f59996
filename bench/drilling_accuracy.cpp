// SPDX-License-Identifier: Apache-2.0
// Where a drill's force and hole are harder to get right than on a plain layer, each against its own reference:
//
//   a hole that crosses an older one at 45°, axes meeting       the exact lip integral over the bone that is left
//   borders that an image tells, by partial volume and noise    the same over the bone the image was made of
//   the volume of a through hole tilted by 30°                  πR² t / cos 30°
//   a real scan on grids shifted by parts of a voxel            the mean of all (repeatability)
//
// 5.4 mm drill at 1000 rpm, edge pitch 0.05 mm, the feed prescribed.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bone/import/ct_body.h"
#include "bone/import/make_body.h"
#include "documents/read_anatomy.h"
#include "run/verdict/step_monitor.h"
#include "studies/chart/drill/reference.h"
#include "tests/support/drill_rig.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double diameter = 5.4_mm, feed = 8.0_mm_per_s, turns = 1000.0_rpm;

/// Its motor turns it whatever the prescribed feed asks: at 50 mm/s ten newton metres.
ToolSetup drill_setup() {
    return test::twist_drill({{"diameter", diameter}, {"element_pitch", 0.05_mm}, {"motor_torque", 100.0}});
}

chart::CuttingLaw law_of_the_plugin() {
    for (const ComponentInfo& c : test::plugins().catalog())
        if (c.id == "drill_cutting") return chart::cutting_law_of(c.parameters).value();
    std::abort();
}

/// A drill led from pose to pose, which knows how far it has turned.
struct Led {
    ToolSetup setup = drill_setup();
    Simulation simulation;
    int ticks = 0;

    Led(const Body& body, const Pose& start) : simulation(body, setup, test::outline(setup), test::gains(), start) {}
    double to(const Pose& pose) {
        const TickResult r = simulation.tick_direct({pose});
        ++ticks;
        return r.thrust;
    }
    /// The motor follows at once, but it is told at the end of the first tick.
    [[nodiscard]] double angle() const { return 2.0 * pi * turns * Simulation::dt * std::max(0, ticks - 1); }
};

struct Error {
    double squared = 0.0, mean = 0.0, count = 0.0;
    [[nodiscard]] double relative() const { return std::sqrt(squared / count) / (mean / count); }
};

/// Along the scene's way, as far as an edge is in bone.
Error thrust_error(Led& led, const chart::Scene& scene, const chart::CuttingLaw& law) {
    chart::ExactForce exact(scene, law);
    Error error;
    for (std::size_t t = 1; t < scene.depth.size(); ++t) {
        const double rate = (scene.depth[t] - scene.depth[t - 1]) / Simulation::dt;
        const double reference = -exact.wrench(scene.pose_at(scene.depth[t - 1]), rate, led.angle())[2];
        const double thrust = led.to(scene.pose_at(scene.depth[t]));
        if (!(reference > 0.0)) continue;
        error.squared += (thrust - reference) * (thrust - reference);
        error.mean += reference;
        error.count += 1.0;
    }
    return error;
}

Vec3 random_offset(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double x = share(random), y = share(random);
    return {x, y, share(random)};
}

// ---- an older hole ------------------------------------------------------------------------------------------------

void crossing(int offsets) {
    constexpr double thickness = 16.0_mm, above = 1.0_mm;
    const chart::CuttingLaw law = law_of_the_plugin();
    const Vec3 low{-18.0_mm, -5.0_mm, -thickness}, high{18.0_mm, 5.0_mm, 0.0};
    chart::Scene whole;
    whole.bone = {[=](Vec3 p) { return test::box_distance(p, low, high); }, {{"cortical", 1850.0, {}}}, low, high};
    whole.drill.diameter = diameter;
    whole.drill.point_angle = 118.0_deg;
    chart::Scene second = whole;
    second.bone.surface = [=](Vec3 p) {
        return std::max(test::box_distance(p, low, high), 0.5 * diameter - std::hypot(p.x, p.y));
    };
    second.along = normalized(Vec3{1, 0, -1});
    second.entry = {-0.5 * thickness, 0, 0};  // the axes meet in the middle of the block
    second.depth = {-above - 0.5 * diameter};
    chart::go_to(second, thickness * std::sqrt(2.0) + diameter, feed);

    for (const double h : {0.5_mm, 0.2_mm}) {
        std::mt19937 random(42);
        double sum = 0.0, worst = 0.0;
        for (int k = 0; k < offsets; ++k) {
            const Body body = chart::body_of(whole.bone, h, random_offset(random));
            Led led(body, test::at_depth(-above));
            const auto down = [&](double from, double to, double speed) {
                const int ticks = static_cast<int>(std::ceil(std::abs(to - from) / (speed * Simulation::dt)));
                for (int t = 1; t <= ticks; ++t) (void)led.to(test::at_depth(from + (to - from) * t / ticks));
            };
            down(-above, thickness + 3.0_mm, feed);
            down(thickness + 3.0_mm, -30.0_mm, 0.5);
            // Through the air to where the second hole begins.
            const Pose from = test::at_depth(-30.0_mm), to = second.pose_at(-60.0_mm),
                       begin = second.pose_at(second.depth[0]);
            for (int t = 1; t <= 200; ++t) (void)led.to(between(from, to, t / 200.0));
            for (int t = 1; t <= 200; ++t) (void)led.to(between(to, begin, t / 200.0));
            const double relative = thrust_error(led, second, law).relative();
            sum += relative;
            worst = std::max(worst, relative);
        }
        std::printf("hole crossing an older one at 45°, axes meeting  %4.2f mm  thrust %5.2f %% rms (worst %.2f %%)\n",
                    1e3 * h, 100.0 * sum / offsets, 100.0 * worst);
        std::fflush(stdout);
    }
}

// ---- what an image tells of a border ------------------------------------------------------------------------------

/// An image of voxels of `h`, each with the share of 8³ points in it that lie inside, and noise of 0.05.
bone::VoxelImage occupancy(const std::function<double(Vec3)>& inside, Vec3 low, Vec3 high, double h,
                           std::mt19937& random) {
    std::normal_distribution<double> noise(0.0, 0.05);
    bone::VoxelImage image;
    const Vec3 shift = h * random_offset(random), extent = high - low;
    image.size = {static_cast<int>(extent.x / h) + 2, static_cast<int>(extent.y / h) + 2,
                  static_cast<int>(extent.z / h) + 2};
    image.place({h, 0, 0, low.x - shift.x, 0, h, 0, low.y - shift.y, 0, 0, h, low.z - shift.z});
    constexpr int sub = 8;
    for (int k = 0; k < image.size[2]; ++k)
        for (int j = 0; j < image.size[1]; ++j)
            for (int i = 0; i < image.size[0]; ++i) {
                const Vec3 centre = image.lps({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
                const double d = inside(centre);
                double share = d < 0.0 ? 1.0 : 0.0;
                if (std::abs(d) < h) {
                    int count = 0;
                    for (int n = 0; n < sub * sub * sub; ++n) {
                        const auto at = [&](int m) { return ((m + 0.5) / sub - 0.5) * h; };
                        count += inside(centre + Vec3{at(n % sub), at(n / sub % sub), at(n / sub / sub)}) < 0.0;
                    }
                    share = count / static_cast<double>(sub * sub * sub);
                }
                image.values.push_back(static_cast<float>(share + noise(random)));
            }
    return image;
}

/// What import makes of such an image: the distance to its border.
bone::VoxelImage border_of(const bone::VoxelImage& image) {
    documents::Anatomy anatomy;
    anatomy.file = "image";
    anatomy.ct.emplace().threshold = 0.5;
    anatomy.tissues = {{"bone", 1850.0, 0.0, ""}};
    const Vec3 end = image.lps({image.size[0] - 1.0, image.size[1] - 1.0, image.size[2] - 1.0});
    anatomy.axes = {{"all", image.lps({0, 0, 0}), end, 0.0}};
    text::Diagnostics diagnostics;
    auto bone = bone::make_ct_bone(anatomy, image, nullptr).take(diagnostics);
    if (!bone) {
        std::fputs(to_text(diagnostics).c_str(), stderr);
        std::abort();
    }
    return std::move(bone->distance);
}

void partial_volume(int offsets) {
    const chart::CuttingLaw law = law_of_the_plugin();
    for (const double tilt : {0.0_deg, 10.0_deg}) {
        const chart::Scene scene = chart::slab_scene(tilt);
        const Vec3 low = scene.bone.low, high = scene.bone.high;
        for (const double h : {0.5_mm, 0.2_mm}) {
            std::mt19937 random(42);
            double sum = 0.0, squares = 0.0, worst = 0.0;
            for (int k = 0; k < offsets; ++k) {
                Body body = chart::body_of(scene.bone, h, random_offset(random));
                const bone::VoxelImage outer = border_of(occupancy(scene.bone.surface, low, high, h, random));
                body.surface = LevelSet::build(body.grid(), [&](Vec3 p) { return outer.sample_trilinear(p, 1.0); });
                for (std::size_t m = 0; m + 1 < scene.bone.tissues.size(); ++m) {
                    const bone::VoxelImage inner =
                        border_of(occupancy(scene.bone.tissues[m].border, low, high, h, random));
                    body.materials[m].border =
                        LevelSet::build(body.grid(), [&](Vec3 p) { return inner.sample_trilinear(p, 1.0); });
                }
                Led led(body, scene.pose_at(scene.depth[0]));
                const double relative = thrust_error(led, scene, law).relative();
                sum += relative;
                squares += relative * relative;
                worst = std::max(worst, relative);
            }
            const double mean = sum / offsets,
                         error_of_mean = std::sqrt((squares / offsets - mean * mean) / (offsets - 1));
            std::printf("slab at %2.0f°, borders from partial volume        %4.2f mm  thrust %5.2f %% rms (worst %.2f "
                        "%%), mean of %d offsets ± %.3f %%\n",
                        tilt / 1.0_deg, 1e3 * h, 100.0 * mean, 100.0 * worst, offsets, 100.0 * error_of_mean);
            std::fflush(stdout);
        }
    }
}

// ---- a volume -----------------------------------------------------------------------------------------------------

void tilted_volume(int offsets) {
    constexpr double thickness = 6.0_mm, tilt = 30.0_deg;
    const double exact = pi * 0.25 * diameter * diameter * thickness / std::cos(tilt);
    const Vec3 low{-12.0_mm, -8.0_mm, -thickness}, high{12.0_mm, 8.0_mm, 0.0};
    const chart::ExactBone bone{
        [=](Vec3 p) { return test::box_distance(p, low, high); }, {{"cortical", 1850.0, {}}}, low, high};
    for (const double h : {0.5_mm, 0.2_mm}) {
        std::mt19937 random(42);
        double sum = 0.0, worst = 0.0;
        for (int k = 0; k < offsets; ++k) {
            const Body body = chart::body_of(bone, h, random_offset(random));
            Led led(body, test::at_depth(-6.0_mm, tilt));
            for (double depth = -6.0_mm; depth < 16.0_mm; depth += 0.05_mm) (void)led.to(test::at_depth(depth, tilt));
            led.simulation.finish();
            const double removed = led.simulation.present().removed();
            const double off = removed / exact - 1.0;
            sum += off;
            worst = std::max(worst, std::abs(off));
        }
        std::printf("through hole tilted by 30°                       %4.2f mm  volume %+6.3f %% (worst %.3f %%)\n",
                    1e3 * h, 100.0 * sum / offsets, 100.0 * worst);
        std::fflush(stdout);
    }
}

// ---- a scan -------------------------------------------------------------------------------------------------------

/// The anatomy with one axis more, which makes the region that is kept, and so the grid of every spacing, begin so much
/// lower [m].
documents::Anatomy begun_lower(const documents::Anatomy& anatomy, Vec3 by) {
    documents::LandmarkAxis corner = anatomy.axes.front();
    for (const documents::LandmarkAxis& axis : anatomy.axes)
        for (const Vec3 end : {axis.from, axis.to})
            corner.from = {std::min(corner.from.x, end.x), std::min(corner.from.y, end.y),
                           std::min(corner.from.z, end.z)};
    corner.from = corner.from - by;
    documents::Anatomy lower = anatomy;
    lower.axes.push_back(corner);
    return lower;
}

/// The scan's own voxels stay where they are: this tells of our grid, not of the scanner's.
void repeatability(const char* name, int grids) {
    text::Diagnostics diagnostics;
    const auto anatomy = documents::read_anatomy(std::string("tests/real-data/") + name).take(diagnostics);
    if (!anatomy) {
        std::printf("%s: not there (KERF_DATA), left out\n", name);
        return;
    }
    for (const double h : {0.5_mm, 0.25_mm}) {
        std::vector<std::vector<double>> thrusts;
        std::mt19937 random(42);
        for (int k = 0; k < grids; ++k) {
            const auto body = bone::make_body(begun_lower(*anatomy, h * random_offset(random)), h).take(diagnostics);
            if (!body) {
                std::printf("%s: its scan is not there (KERF_DATA), left out\n", name);
                return;
            }
            const documents::LandmarkAxis& axis = anatomy->axes.front();
            const run::AxisFrame frame = run::axis_frame(axis, bone::axis_in_bone(*body, axis).entry, *anatomy);
            // The same way in every one, whatever its own entry is.
            static Vec3 entry;
            if (k == 0) entry = frame.entry;
            const auto at = [&](double depth) {
                return Pose{entry + depth * frame.along, quat_between({0, 0, 1}, frame.along)};
            };
            Led led(*body, at(-5.0_mm));
            auto& thrust = thrusts.emplace_back();
            for (double depth = -5.0_mm; depth < 25.0_mm; depth += 2.0_mm_per_s * Simulation::dt)
                thrust.push_back(led.to(at(depth)));
        }
        double spread = 0.0, whole = 0.0;
        for (std::size_t t = 0; t < thrusts[0].size(); ++t) {
            double mean = 0.0;
            for (const auto& one : thrusts) mean += one[t] / grids;
            for (const auto& one : thrusts) spread += (one[t] - mean) * (one[t] - mean) / (grids - 1);
            whole += mean * mean;
        }
        std::printf("%-12s on %2d grids shifted within a voxel         %4.2f mm  thrust %5.2f %% of its rms, standard "
                    "deviation\n",
                    name, grids, 1e3 * h, 100.0 * std::sqrt(spread / whole));
        std::fflush(stdout);
    }
}

}  // namespace

int main() {
    crossing(10);
    partial_volume(400);
    tilted_volume(20);
    for (const char* name : {"l3.yaml", "t12.yaml"}) repeatability(name, 10);
    return 0;
}
