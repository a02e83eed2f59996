// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/chart/exact_bone.h"
#include "studies/chart/named_setup.h"
#include "studies/chart/powered/exact_cut.h"
#include "studies/chart/track.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// Another law that is taken along the path of a scene.
struct Rival {
    std::string id{}, title{};
    NamedSetup setup{};
    std::string points{};      ///< its parameter for sample points; empty: it has none
    int usual_points = 0;      ///< how many
    double more_points = 2.0;  ///< how many times these S-07 takes
    std::string scale{};       ///< the parameter that its force is proportional to, set in a block; empty: none
    bool is_as_printed = false;
};

/// A powered cutter on a prescribed path through bone: all that the chart has to know of one.
struct PoweredScene {
    std::string id{};      ///< "burr-groove"
    std::string title{};   ///< for people
    std::string cutter{};  ///< "burr": scenes of one cutter share its tests and its K_max
    ExactBone bone{};
    NamedSetup tool{};
    std::string points{};                 ///< the law's parameter for sample points; empty: it has none
    int usual_points = 0;                 ///< of a curve that sweeps the spacing
    std::vector<int> points_sweep{};      ///< of the curve that sweeps them
    std::vector<double> spacing_sweep{};  ///< [m] coarse to fine
    std::vector<Pose> path{};             ///< of the tool at the end of each tick; the first: where it begins
    double feed = 0.0;                    ///< [m/s] of most of it
    double working_force = 30.0;          ///< [N] that a procedure would say under `haptics:`
    double trial_depth = 0.0;             ///< [m] to which the tests feed it into a block
    double trial_feed = 0.0;              ///< [m/s] at which they do
    std::vector<Rival> rivals{};
    /// Parameters that `exact` needs. A plugin without one of them is refused.
    std::vector<std::string> needs{};
    /// The exact law in this bone. The scene must outlive it.
    std::function<std::unique_ptr<ExactCut>(const PoweredScene&, const Values&)> exact{};
    std::optional<double> volume{};    ///< [m³] that the path takes, in closed form; nothing: a replay tells
    std::optional<TorqueLine> line{};  ///< about which the torque is compared
    std::string note{};                ///< for people: what the reference is, where it is not one thing

    [[nodiscard]] std::size_t ticks() const noexcept { return path.size() - 1; }
};

/// Appends a straight way of the tool to a point at `speed` [m/s]: whole ticks, the last one shorter. It does not turn.
void go_straight(std::vector<Pose>& path, Vec3 to, double speed);
/// [m³] that a ball takes which comes to rest in a groove of flat bone, `depth` [m] ≤ radius below the face, `length`
/// [m] from an edge across its way: slot and the front half of its cap.
[[nodiscard]] double groove_volume(double radius, double depth, double length) noexcept;

/// A block of the hardest tissue, as deep as the scene's tests need; the tool above it, along −z.
[[nodiscard]] PoweredScene powered_block(const PoweredScene& like, double reach, double across);

/// 04-12: a groove 1 mm deep by a round burr of 4 mm, entered across an edge.
[[nodiscard]] PoweredScene burr_groove_scene();
/// The same burr 0, 1, 10 and 50 µm below a plane, and back along each of these grooves.
[[nodiscard]] PoweredScene grazing_scene();
/// A reciprocating blade across the angle of a mandible, twisted in its slot on the way.
[[nodiscard]] PoweredScene mandible_scene();

/// All of them, in the order of the chart.
[[nodiscard]] std::vector<PoweredScene> all_powered_scenes();

}  // namespace kerf::chart
