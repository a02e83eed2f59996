// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "studies/chart/run.h"

/// Tests of force that any tool is put to in front of a block of bone. For training and research; not for diagnosis,
/// planning or deciding treatment.
namespace kerf::chart {

inline constexpr double no_force = 0.05;  ///< [N] less is as good as none

/// A tool that is fed into a block along its axis.
struct Trial {
    std::function<std::unique_ptr<Run>(double more_points)> start{};  ///< with so many times the points
    std::function<Pose(double depth)> pose_at{};
    Vec3 entry{}, along{0, 0, -1};
    std::vector<double> depth{};     ///< [m] of the tip at the end of each tick; the first: where it begins
    double feed = 0.0;               ///< [m/s] of them
    double bottom = 0.0, top = 0.0;  ///< [m] how deep it goes for `back_in_the_hole`, and how far out
    double back_speed = 20e-3;       ///< [m/s] in the hole
    double more_points = 2.0;        ///< how many times the points are compared with once
};

struct Verdict {
    bool passes;
    std::string told;
};

/// S-07: so many times the points change the mean force of the last millimetre by less than 5 %.   [main]
[[nodiscard]] Verdict with_more_points(const Trial& trial);
/// S-12: into the block, back in the hole and in again: under 0.05 N from 0.05 mm before the deepest point on. A hand
/// that leads continues until the tool has followed.   [main]
[[nodiscard]] Verdict back_in_the_hole(const Trial& trial);
/// The tool is still in bone: first with its drive on (P9: under 0.05 N), then off (S-19: every force is finite).
struct Still {
    Verdict on, off;
};
[[nodiscard]] Still still_in_bone(const Trial& trial);

/// How a method at one fineness does in the tests of force, wherever it is used.
struct Standing {
    std::string method{}, knob{};
    std::string cutter = "drill";
    std::vector<std::string> fails{};  ///< by id
    std::string told{};                ///< what each test measured

    void add(const char* id, const Verdict& verdict);
    /// S-07, if points are compared, S-12, P9 and S-19. A tool that a hand leads holds a stretch at rest: without P9.
    /// [main]
    void add_trials(const Trial& trial, bool is_led_by_hand);
};

}  // namespace kerf::chart
