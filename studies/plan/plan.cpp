// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <utility>

#include "studies/rms.h"
#include "text/plain_numbers.h"

namespace kerf::plan {

namespace {

constexpr double finest[] = {0.1e-3, 0.125e-3, 0.18e-3};  // [m] the first that can be had
constexpr double ladder[] = {1.0e-3, 0.7e-3, 0.5e-3, 0.35e-3, 0.25e-3, 0.18e-3, 0.125e-3};  // [m]
constexpr double pitch_steps[] = {8.0, 4.0, 2.0};  // of the procedure's own pitch, coarsest first

std::string in_mm(double metres) {
    const text::PlainNumbers point;
    char text[32];
    std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
    return text;
}

/// A way of modelling the step, and what it is made of.
struct Model {
    Choice choice;
    ToolSetup setup = {};
    Body body = {};
    Met whole = {};  ///< what the tool meets before anything is left out
    std::vector<Feature> removable = {};
    std::vector<FeatureFound> features = {};
    bool changes_are_anothers = false;  ///< of a coarser spacing, which they hardly depend on
};

class Planner {
public:
    Planner(const Task& task, const Progress& progress)
        : task_(task), progress_(progress), pitch_(pitch_of(task.force)) {}

    std::optional<StepPlan> plan(std::string& error) {
        plan_.step = task_.step;
        if (!find_reference(error)) return std::nullopt;
        std::optional<Model> best;
        for (const double spacing : ladder) {
            if (spacing <= plan_.reference.spacing) break;
            if (spacing > task_.coarsest && spacing > *std::prev(std::end(ladder))) continue;
            std::optional<Model> model;
            if (!make(spacing, model, error)) return std::nullopt;
            if (!model) continue;
            if (!keeps(model->choice)) {
                if (!best || !keeps(best->choice)) best = std::move(model);
                continue;
            }
            std::size_t row = plan_.tried.size() - 1;
            if (!lengthen_elements(*model, row, error) ||
                !find_features(*model, best && keeps(best->choice) ? &*best : nullptr, error) ||
                !leave_out_features(*model, error))
                return std::nullopt;
            model->choice.cost = timed(*model);
            const bool is_done = model->choice.keeps(task_.budget) || !task_.budget.is_given;
            if (!is_done) plan_.tried[row].is_over_budget = true;
            if (is_done || !best || !keeps(best->choice) || model->choice.cost->p999 < best->choice.cost->p999)
                best = std::move(model);
            if (is_done) break;
        }
        if (!best) {
            error = "step `" + task_.step + "`: the bone can be made at no spacing from 0.125 to 1 mm.";
            return std::nullopt;
        }
        if (!keeps(best->choice)) {
            if (!find_features(*best, nullptr, error)) return std::nullopt;
            best->choice.cost = timed(*best);
        }
        if (task_.budget.is_given && !best->choice.keeps(task_.budget) && !find_cheaper(*best, error))
            return std::nullopt;
        if (best->changes_are_anothers && !find_changes(*best, error)) return std::nullopt;
        plan_.chosen = best->choice;
        plan_.keeps_accuracy = keeps(best->choice);
        plan_.features = std::move(best->features);
        if (auto body = task_.bone_at(task_.spacing)) {
            tell("timing a tick as the procedure is written");
            plan_.cost_as_written = task_.cost_of(*body, task_.setup, task_.gains, task_.way);
        }
        return plan_;
    }

private:
    void tell(const std::string& what) const {
        if (progress_) progress_("step " + task_.step + ": " + what);
    }
    [[nodiscard]] double own_pitch() const { return pitch_ ? task_.setup.force_parameters[pitch_->param] : 0.0; }
    [[nodiscard]] ToolSetup with_pitch(double pitch) const {
        ToolSetup setup = task_.setup;
        if (pitch_) setup.force_parameters[pitch_->param] = pitch;
        return setup;
    }
    [[nodiscard]] bool keeps(const Choice& choice) const { return choice.keeps(task_.accuracy, plan_.torque_counts); }

    bool find_reference(std::string& error) {
        const double pitch = pitch_ ? std::max(pitch_->finest, 0.5 * own_pitch()) : 0.0;
        ToolOutline outline;
        if (!outline_of(task_.setup, outline, error)) return false;
        for (const double spacing : finest) {
            tell("reference at " + in_mm(spacing));
            const auto body = task_.bone_at(spacing);
            if (!body) continue;
            if (!go(*body, with_pitch(pitch), task_.way, reference_, error)) return false;
            plan_.reference = {.spacing = spacing, .pitch = pitch};
            plan_.reference_force = rms(reference_.force);
            plan_.reference_torque = rms(reference_.torque);
            plan_.torque_counts = plan_.reference_torque >=
                                  task_.accuracy.force * plan_.reference_force * outline.cutting.largest_radius();
            if (reference_.removed > 0.0 && plan_.reference_force > 0.0) return true;
            error = "step `" + task_.step +
                    "`: its tool meets no bone on its way, so there is nothing to plan. Give a goal of depth that lies "
                    "in the bone.";
            return false;
        }
        error = "step `" + task_.step + "`: the bone cannot be made at " + in_mm(finest[2]) +
                " or finer, the reference of plans. Make the region around the axes smaller.";
        return false;
    }

    /// The cost of what is over the budget, but not hopelessly, is asked again, and the least is taken: whatever else
    /// the processor did only adds to it.
    Cost timed(const Model& model) const {
        tell("timing a tick at " + in_mm(model.choice.spacing));
        Cost least = task_.cost_of(model.body, model.setup, task_.gains, task_.way);
        const double budget = 1e6 * task_.budget.tick;
        for (int again = 0; again < 2 && task_.budget.is_given && least.p999 > budget && least.p999 < 2.0 * budget;
             ++again) {
            const Cost cost = task_.cost_of(model.body, model.setup, task_.gains, task_.way);
            if (cost.p999 < least.p999) least = cost;
        }
        return least;
    }

    /// Everything in place at a spacing. No model: the bone cannot be had so.
    bool make(double spacing, std::optional<Model>& model, std::string& error) {
        tell("bone at " + in_mm(spacing));
        Choice choice{.spacing = spacing, .pitch = own_pitch()};
        auto body = task_.bone_at(spacing);
        choice.has_bone = body.has_value();
        if (body) {
            model = Model{.choice = choice, .setup = task_.setup, .body = std::move(*body)};
            if (!measure(*model, error)) return false;
            choice = model->choice;
        }
        plan_.tried.push_back(choice);
        return true;
    }

    /// What is off, and what it costs if that is little enough.
    bool measure(Model& model, std::string& error) const {
        if (!go(model.body, model.setup, task_.way, model.whole, error)) return false;
        model.choice.error = apart(model.whole, reference_);
        if (keeps(model.choice)) model.choice.cost = timed(model);
        return true;
    }

    /// @param row  in: of the model, out: of what it has become
    bool lengthen_elements(Model& model, std::size_t& row, std::string& error) {
        if (!pitch_) return true;
        for (const double times : pitch_steps) {
            Model longer{
                .choice = {.spacing = model.choice.spacing, .pitch = std::min(pitch_->coarsest, times * own_pitch())}};
            if (longer.choice.pitch <= own_pitch()) continue;
            tell("elements " + std::to_string(static_cast<int>(times)) + " times as long");
            longer.setup = with_pitch(longer.choice.pitch);
            longer.body = model.body;
            if (!measure(longer, error)) return false;
            plan_.tried.push_back(longer.choice);
            if (!keeps(longer.choice)) continue;
            model = std::move(longer);
            row = plan_.tried.size() - 1;
            return true;
        }
        return true;
    }

    /// What is there, and what leaving out each alone would change: as much as of `before`, if there is one.
    bool find_features(Model& model, const Model* before, std::string& error) const {
        model.removable = features_of(model.setup, task_.tool, task_.force, model.body);
        for (const Feature& feature : model.removable) model.features.push_back({feature.id, feature.help, {}, false});
        const auto same_id = [](const FeatureFound& a, const FeatureFound& b) { return a.id == b.id; };
        if (before == nullptr || !std::equal(model.features.begin(), model.features.end(), before->features.begin(),
                                             before->features.end(), same_id))
            return changes_of(model, model, error);
        for (std::size_t i = 0; i < model.features.size(); ++i) model.features[i].change = before->features[i].change;
        model.changes_are_anothers = true;
        return true;
    }
    /// Of one in which something is left out already.
    bool find_changes(Model& model, std::string& error) const {
        auto body = task_.bone_at(model.choice.spacing);
        Model all{.choice = model.choice,
                  .setup = with_pitch(model.choice.pitch),
                  .body = body ? std::move(*body) : model.body};
        return changes_of(all, model, error);
    }
    bool changes_of(const Model& all, Model& model, std::string& error) const {
        for (std::size_t i = 0; i < model.features.size(); ++i) {
            tell("without " + model.features[i].id);
            Model less = without(all, model.removable[i]);
            if (!go(less.body, less.setup, task_.way, less.whole, error)) return false;
            model.features[i].change = apart(less.whole, model.whole);
        }
        return true;
    }

    /// Those that change least go first, as long as all that is left out together stays within the accuracy.
    bool leave_out_features(Model& model, std::string& error) const {
        const auto change = [&](std::size_t i) { return model.features[i].change.felt(plan_.torque_counts); };
        std::vector<std::size_t> order(model.features.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return change(a) < change(b); });
        for (const std::size_t i : order) {
            if (change(i) > task_.accuracy.force) break;
            tell("and without " + model.features[i].id);
            Model less = without(model, model.removable[i]);
            if (!go(less.body, less.setup, task_.way, less.whole, error)) return false;
            less.choice.error = apart(less.whole, reference_);
            if (!keeps(less.choice)) continue;
            model.choice = less.choice;
            model.setup = std::move(less.setup);
            model.body = std::move(less.body);
            model.features[i].is_left_out = true;
        }
        return true;
    }
    static Model without(const Model& model, const Feature& feature) {
        Model less{.choice = model.choice, .setup = model.setup, .body = model.body};
        feature.leave_out(less.setup, less.body);
        return less;
    }

    /// Whatever was tried and is not accurate, without what is left out of the chosen; and the chosen without one
    /// feature more.
    bool find_cheaper(const Model& chosen, std::string& error) {
        double cheapest = chosen.choice.cost->p999;
        const auto add = [&](Model& model, const std::string& left_out) {
            model.choice.cost = timed(model);
            if (!model.choice.keeps(task_.budget) && model.choice.cost->p999 >= cheapest) return true;
            cheapest = std::min(cheapest, model.choice.cost->p999);
            if (!go(model.body, model.setup, task_.way, model.whole, error)) return false;
            model.choice.error = apart(model.whole, reference_);
            if (!keeps(model.choice))
                plan_.cheaper.push_back(
                    {model.choice, left_out});  // else errors cancel, by chance: nothing to build on
            return true;
        };
        for (const Choice& choice : plan_.tried) {
            if (!choice.has_bone || keeps(choice) || is_same(choice, chosen.choice)) continue;
            tell("what is cheaper, at " + in_mm(choice.spacing));
            auto body = task_.bone_at(choice.spacing);
            if (!body) continue;
            Model model{.choice = choice, .setup = with_pitch(choice.pitch), .body = std::move(*body)};
            for (std::size_t i = 0; i < chosen.features.size(); ++i)
                if (chosen.features[i].is_left_out) chosen.removable[i].leave_out(model.setup, model.body);
            if (!add(model, "")) return false;
        }
        for (std::size_t i = 0; i < chosen.features.size(); ++i) {
            if (chosen.features[i].is_left_out) continue;
            tell("what is cheaper, without " + chosen.features[i].id);
            Model model = without(chosen, chosen.removable[i]);
            if (!add(model, chosen.features[i].id)) return false;
        }
        return true;
    }

    const Task& task_;
    const Progress& progress_;
    std::optional<Pitch> pitch_;
    StepPlan plan_;
    Met reference_;
};

}  // namespace

std::optional<StepPlan> plan_step(const Task& task, const Progress& progress, std::string& error) {
    return Planner(task, progress).plan(error);
}

}  // namespace kerf::plan
