// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conformance/plan/going.h"
#include "core/procedure/procedure.h"

/// The least that a step needs. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::plan {

/// What a plan is made from.
struct Task {
    std::string step, instrument;  ///< ids
    BoneAt bone_at;
    ToolSetup setup;   ///< as the procedure says, every feature in place
    ComponentInfo tool, force;
    CouplingGains gains;
    Way way;
    double spacing = 0.25e-3;  ///< [m] as the procedure says
    double coarsest = 1e300;   ///< [m] at which the tool's own cut is still known
    Accuracy accuracy;
    Budget budget;
};

/// One way of modelling the step.
struct Choice {
    double spacing = 0.0;  ///< [m]
    double pitch = 0.0;    ///< SI of the law's own; 0 where it has none
    bool has_bone = true;  ///< the bone could be made at this spacing
    Apart error = {};      ///< against the reference
    [[nodiscard]] bool keeps(const Accuracy& accuracy) const noexcept {
        return has_bone && error.force <= accuracy.force && error.volume <= accuracy.volume;
    }
};

struct FeatureFound {
    std::string id, help;
    Apart change;  ///< that leaving out this one alone would make to what is chosen
    bool is_left_out = false;
};

struct StepPlan {
    std::string step;
    Choice reference;  ///< the finest: what errors are against
    double reference_force = 0.0, reference_torque = 0.0;  ///< RMS along the way [N], [N·m]
    std::vector<Choice> tried;  ///< spacings from the coarsest on, until one keeps the accuracy; then pitches
    Choice chosen;              ///< with every feature that is not left out
    bool keeps_accuracy = false;
    std::vector<FeatureFound> features;
    Cost cost, cost_as_written;  ///< of what is chosen, and of the procedure as it stands
    [[nodiscard]] bool keeps(const Budget& budget) const noexcept { return cost.p999 <= 1e6 * budget.tick; }
};

using Progress = std::function<void(const std::string& what)>;

/// Finds, in this order, the coarsest spacing at which the tool's cut is known, the coarsest pitch and the fewest features whose force and removed volume
/// stay within the accuracy of what the finest field gives with all of them. Errors are of a prescribed motion, and
/// deterministic; only the cost is timed.
/// Error: no bone at any spacing, a tool that cannot be made, a way that meets no bone.   [main]
[[nodiscard]] std::optional<StepPlan> plan_step(const Task& task, const Progress& progress, std::string& error);

}  // namespace kerf::plan
