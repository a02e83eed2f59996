// SPDX-License-Identifier: Apache-2.0
#include "app/programs/plan_procedure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/progress.h"
#include "app/standard_streams.h"
#include "bone/import/make_body.h"
#include "run/exact/compare_strategies.h"
#include "run/planned_feed.h"
#include "run/run_checks.h"
#include "session/recorder.h"
#include "studies/plan/plan_text.h"
#include "text/write_file.h"

namespace kerf::app {

namespace {

const ComponentInfo& info_of(const PluginRegistry& plugins, const documents::Instrument& instrument,
                             std::uint32_t kind) {
    const std::string& id = kind == KERF_KIND_TOOL ? instrument.tool : instrument.force;
    const std::string& plugin = kind == KERF_KIND_TOOL ? instrument.plugin : instrument.force_plugin;
    const auto& catalog = plugins.catalog();
    return *std::find_if(catalog.begin(), catalog.end(), [&](const ComponentInfo& info) {
        return info.plugin == plugin && info.kind == kind && info.id == id;
    });
}

/// Returns the depth of the step's goal; without one, the depth that passing rehearsals reach [m].
double depth_of(std::size_t s, const documents::Procedure& procedure) {
    const documents::Step& step = procedure.steps[s];
    double depth = 0.0;
    for (const documents::Goal& goal : step.goals)
        if (goal.quantity == "depth" && goal.bound.at_least) depth = std::max(depth, *goal.bound.at_least);
    if (depth > 0.0) return depth;
    for (const documents::Rehearsal& rehearsal : procedure.rehearsals)
        if (rehearsal.expect == "pass")
            for (const documents::Waypoint& waypoint : rehearsal.path)
                if (waypoint.step == s) depth = std::max(depth, waypoint.depth);
    return depth;
}

/// The surfaces that the planned cut of a step may leave, and the fastest one whose volume is as accurate as required.
std::string surface_text(const std::vector<run::StrategyCost>& costs, double accuracy) {
    const run::StrategyCost& exact = costs.back();
    const bool has_reference = exact.why_not.empty() && exact.removed > 0.0;
    const run::StrategyCost* chosen = nullptr;
    std::string text = "\n  surface                   removed      off        farthest   faces     time\n";
    for (const run::StrategyCost& cost : costs) {
        if (!cost.why_not.empty()) {
            text += formatted("  %-24s  none: ", cost.strategy.c_str()) + cost.why_not + "\n";
            continue;
        }
        const double off = has_reference ? std::abs(cost.removed / exact.removed - 1.0) : 0.0;
        if (has_reference && off <= accuracy && (chosen == nullptr || cost.seconds < chosen->seconds)) chosen = &cost;
        text += formatted("  %-24s  %-11s  %-9s  %-9s  %-8zu  %.2f s\n", cost.strategy.c_str(),
                          (bone::rounded(cost.removed * 1e9, 1) + " mm3").c_str(),
                          has_reference ? (bone::rounded(100.0 * off, 3) + " %").c_str() : "-",
                          has_reference ? (bone::rounded(cost.farthest * 1e3, 4) + " mm").c_str() : "-", cost.triangles,
                          cost.seconds);
    }
    if (!has_reference && costs.size() > 1)
        text += "  without `" + exact.strategy + "`, the most accurate, there is nothing to compare with\n";
    if (chosen == nullptr) return text;
    return text + "  the fastest within " + bone::rounded(100.0 * accuracy, 1) +
           " % of the volume: `remeshing: " + chosen->strategy + "`; `farthest` is the largest distance at its edges\n";
}

/// Returns the strategies that suit a tool: that of the procedure first, the most accurate last.
std::vector<std::string> strategies_for(const documents::Instrument& instrument, const ComponentInfo& tool) {
    std::vector<std::string> all = tool.strategies;
    if (!instrument.remeshing.empty() && std::find(all.begin(), all.end(), instrument.remeshing) == all.end())
        all.insert(all.begin(), instrument.remeshing);
    return all;
}

std::string write_plan(const std::string& folder, const std::string& text, const std::string& csv) {
    const std::string failed = text::write_file(folder + "/plan.txt", text);
    return failed.empty() ? text::write_file(folder + "/plan.csv", csv) : failed;
}

}  // namespace

PlanOutcome plan_procedure(const run::Scene& scene, const PluginRegistry& plugins, const std::string& folder,
                           const run::StrategyHost& host, const std::function<void(const std::string& text)>& show) {
    const documents::Procedure& procedure = scene.procedure;
    PlanOutcome outcome;
    outcome.is_kept = true;
    text::MadeFolders made;  // made before work that takes minutes
    if (!folder.empty() && !(outcome.error = made.make(folder)).empty()) return outcome;
    std::string text;
    const auto add = [&](const std::string& more) {
        show(more);
        text += more;
    };
    add(std::string(session::notice_line) + ".\n" + procedure.id + ", " + procedure.title + "\n");
    std::vector<plan::StepPlan> plans;
    for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
        const documents::Step& step = procedure.steps[s];
        const auto instrument = std::find_if(procedure.instruments.begin(), procedure.instruments.end(),
                                             [&](const documents::Instrument& i) { return i.id == step.instrument; });
        if (!step.cuts()) continue;  // the step does not depend on the spacing
        const double depth = depth_of(s, procedure);
        if (depth <= 0.0) {
            outcome.error =
                procedure.file + ": step `" + step.id + "` has no depth. Give it a goal `{depth: {at_least: 30 mm}}`.";
            return outcome;
        }
        plan::Task task;
        task.step = step.id;
        task.instrument = step.instrument;
        task.bone_at = [&](double spacing) {
            text::Diagnostics ignored;
            return bone::make_body(scene.anatomy, spacing).take(ignored);
        };
        task.setup = scene.tool(s).setup;
        task.tool = info_of(plugins, *instrument, KERF_KIND_TOOL);
        task.force = info_of(plugins, *instrument, KERF_KIND_FORCE);
        task.gains = scene.gains;
        task.way = {planned_pose(scene, s, -run::in_air_before_entry), run::planned_direction(scene, s),
                    run::in_air_before_entry + depth, step.feed,
                    turn_of_feed(scene.tool(s).setup, scene.tool(s).outline)};
        task.spacing = procedure.spacing;
        task.coarsest = run::coarsest_spacing(scene.tool(s).outline.cutting);
        task.accuracy = procedure.accuracy;
        task.budget = procedure.budget;
        const auto found = plan::plan_step(task, show_work, outcome.error);
        show_work("");
        if (!found) {
            outcome.error = procedure.file + ": " + outcome.error;
            return outcome;
        }
        outcome.is_kept = outcome.is_kept && found->keeps_accuracy && found->keeps(procedure.budget);
        plans.push_back(*found);
        add("\n" + plan::plan_text(task, *found));
        const auto costs =
            run::compare_strategies(scene, s, depth, host, strategies_for(*instrument, task.tool), show_work);
        show_work("");
        add(surface_text(costs, procedure.accuracy.volume));
    }
    outcome.is_planned = true;
    if (!folder.empty()) outcome.error = write_plan(folder, text, plan::plan_csv(plans));
    if (outcome.error.empty()) made.keep();
    return outcome;
}

}  // namespace kerf::app
