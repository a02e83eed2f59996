// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "studies/chart/drill/lip_integral.h"
#include "studies/chart/exact_bone.h"
#include "studies/chart/setting.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A drill on a straight way through bone, its feed prescribed.
struct Scene {
    std::string id{};     ///< "slab-0"
    std::string title{};  ///< for people
    ExactBone bone{};
    Drill drill{};
    double spindle = 1000.0 / 60.0;  ///< [1/s]
    double feed = 8e-3;              ///< [m/s] at which most of it is drilled: what laws are calibrated at
    Vec3 entry{}, along{0, 0, -1};   ///< the tip at depth 0 [m], and the way it goes (unit)
    bool is_oblique = false;         ///< bone is met askew: a drill that finds its own motion walks
    std::vector<double> depth{};     ///< [m] of the tip at the end of each tick; the first: where it begins

    [[nodiscard]] Pose pose_at(double tip_depth) const noexcept {
        return {entry + tip_depth * along, quat_between({0, 0, 1}, along)};
    }
    [[nodiscard]] std::size_t ticks() const noexcept { return depth.size() - 1; }
};

/// Appends a straight stretch at `speed` [m/s] from where the path ends to `to` [m]: whole ticks, the last one shorter.
void go_to(Scene& scene, double to, double speed);

/// C.9: 4 mm cortical, 10 mm that resist a tenth, 4 mm cortical; 5.4 mm drill, 8 mm/s; tilted by `tilt` [rad].
[[nodiscard]] Scene slab_scene(double tilt);
/// Through both walls of a femur's shaft, R_o 13 mm, R_i 5.3 mm, 4.5 mm drill, across its axis (E.1).
[[nodiscard]] Scene femur_scene();
/// Into the trochanter along the neck: 1.5 mm of cortex over cancellous bone, neck at 125° to the shaft (E.1).
[[nodiscard]] Scene trochanter_scene();
/// The pedicle of procedures/anatomy/vertebra-l4-phantom.yaml, 3.2 mm drill, `medial` [m] beside the planned axis.
[[nodiscard]] Scene pedicle_scene(double medial);
/// [m] so far beside the axis the drill goes 1.3 mm into the canal.
inline constexpr double medial_breach = 6.3e-3;
/// How an awl goes into it from the planned entry, and what cortex it meets.
struct AwlAim {
    double towards_canal = 0.0;     ///< [rad] beside the planned axis; negative: away from the canal
    std::optional<double> shell{};  ///< [m] of cortex; none: the phantom's own
    double bone = 1.0;              ///< [–] of the cortex's volume; the rest is pores
};
/// As `pedicle_scene`, for an awl. Of no chart's scenes: without a name.
[[nodiscard]] Scene pedicle_awl_scene(const AwlAim& aim);
/// Pecks at 100 mm/s, out and in at up to 1 m/s, then through 0.5 mm of bone at 1 m/s.
[[nodiscard]] Scene fast_scene();

/// All of them, in the order of the chart.
[[nodiscard]] std::vector<Scene> all_scenes();

}  // namespace kerf::chart
