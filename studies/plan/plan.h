// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "documents/procedure.h"
#include "studies/plan/going.h"

/// The least that a step needs. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::plan {

/// What a plan is made from.
struct Task {
    std::string step, instrument;  ///< ids
    BoneAt bone_at;
    ToolSetup setup;  ///< as the procedure says, every feature in place
    ComponentInfo tool, force;
    CouplingGains gains;
    Way way;
    double spacing = 0.25e-3;  ///< [m] as the procedure says
    double coarsest = 1e300;   ///< [m] at which the tool's own cut is still known
    documents::Accuracy accuracy;
    documents::Budget budget;
    std::function<Cost(const Body&, const ToolSetup&, const CouplingGains&, const Way&)> cost_of =
        &plan::cost_of;  ///< nothing else of a plan is timed
};

/// One way of modelling the step.
struct Choice {
    double spacing = 0.0;           ///< [m]
    double pitch = 0.0;             ///< SI of the law's own; 0 where it has none
    bool has_bone = true;           ///< the bone could be made at this spacing
    bool is_over_budget = false;    ///< it keeps the accuracy, but the budget not even without what can be left out
    Apart error = {};               ///< against the reference
    std::optional<Cost> cost = {};  ///< where it was timed
    /// The torque is held to what is asked of the force.
    [[nodiscard]] bool keeps(const documents::Accuracy& accuracy, bool torque_counts) const noexcept {
        return has_bone && miss(accuracy, torque_counts) <= 1.0;
    }
    /// [–] the worst of its errors as a share of what is asked for.
    [[nodiscard]] double miss(const documents::Accuracy& accuracy, bool torque_counts) const noexcept {
        return std::max(error.felt(torque_counts) / accuracy.force, error.volume / accuracy.volume);
    }
    [[nodiscard]] bool keeps(const documents::Budget& budget) const noexcept {
        return cost && cost->p999 <= 1e6 * budget.tick;
    }
};

/// The same grid and elements, whatever is left out.
[[nodiscard]] inline bool is_same(const Choice& a, const Choice& b) noexcept {
    return a.spacing == b.spacing && a.pitch == b.pitch;
}

struct FeatureFound {
    std::string id, help;
    Apart change;  ///< that leaving out this one alone would make to what is chosen
    bool is_left_out = false;
};

/// What costs less than what is chosen, and is less accurate than asked for.
struct Cheaper {
    Choice choice;        ///< timed, without what is left out of what is chosen
    std::string without;  ///< a feature that is left out besides; empty: none
};

struct StepPlan {
    std::string step;
    Choice reference;                                      ///< the finest: what errors are against
    double reference_force = 0.0, reference_torque = 0.0;  ///< RMS along the way [N], [N·m]
    bool torque_counts = true;                             ///< there is enough of it: see plan_step
    std::vector<Choice>
        tried;      ///< spacings from the coarsest on, pitches after the spacing they go with; every feature in place
    Choice chosen;  ///< with every feature that is not left out; always timed
    bool keeps_accuracy = false;
    std::vector<FeatureFound> features;  ///< of what is chosen
    std::vector<Cheaper> cheaper;        ///< only where nothing that keeps the accuracy keeps the budget
    Cost cost_as_written;                ///< of the procedure as it stands
    [[nodiscard]] bool keeps(const documents::Budget& budget) const noexcept { return chosen.keeps(budget); }
};

using Progress = std::function<void(const std::string& what)>;

/// Finds, in this order, the coarsest spacing at which the tool's cut is known, the longest pitch and the fewest
/// features whose force, torque and removed volume stay within the accuracy of what the finest field gives with all of
/// them. Errors are of a prescribed motion, and deterministic. Where the procedure gives a budget and what was found is
/// over it, finer spacings are gone on to, as a coarser one is not always cheaper: the first that keeps both is chosen;
/// where none does, the cheapest that keeps the accuracy. So what is chosen depends on the clock only where the first
/// choice is over a budget that was asked for.
///
/// The torque counts where its RMS is at least `accuracy.force` times the force's at the rim of the tool: less of it
/// the force's own permitted error, acting at the rim, makes by itself, and what a tool whose torques cancel has left
/// is no more. Error: no bone at any spacing, a tool that cannot be made, a way that meets no bone.   [main]
[[nodiscard]] std::optional<StepPlan> plan_step(const Task& task, const Progress& progress, std::string& error);

}  // namespace kerf::plan
