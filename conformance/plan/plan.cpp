// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/plan/plan.h"

#include <algorithm>
#include <iterator>
#include <cmath>

#include "core/procedure/plain_numbers.h"

namespace kerf::plan {

namespace {

constexpr double finest[] = {0.1e-3, 0.125e-3, 0.18e-3};                               // [m] the first that can be had
constexpr double ladder[] = {1.0e-3, 0.7e-3, 0.5e-3, 0.35e-3, 0.25e-3, 0.18e-3, 0.125e-3};  // [m]
constexpr double pitch_steps[] = {8.0, 4.0, 2.0};  // of the procedure's own pitch, coarsest first

std::string in_mm(double metres) {
    const PlainNumbers point;
    char text[32];
    std::snprintf(text, sizeof text, "%.3g mm", 1e3 * metres);
    return text;
}

double rms(const std::vector<Vec3>& all) {
    double sum = 0.0;
    for (const Vec3 v : all) sum += dot(v, v);
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, all.size())));
}
double rms(const std::vector<double>& all) {
    double sum = 0.0;
    for (const double v : all) sum += v * v;
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, all.size())));
}

class Planner {
public:
    Planner(const Task& task, const Progress& progress) : task_(task), progress_(progress), pitch_(pitch_of(task.force)) {}

    std::optional<StepPlan> plan(std::string& error) {
        plan_.step = task_.step;
        if (!find_reference(error) || !choose_spacing(error) || !choose_pitch(error) || !choose_features(error))
            return std::nullopt;
        tell("timing a tick at " + in_mm(plan_.chosen.spacing));
        plan_.cost = cost_of(without_body_, without_, task_.gains, task_.way);
        if (auto body = task_.bone_at(task_.spacing)) {
            tell("timing a tick as the procedure is written");
            plan_.cost_as_written = cost_of(*body, task_.setup, task_.gains, task_.way);
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

    bool find_reference(std::string& error) {
        const double pitch = pitch_ ? std::max(pitch_->finest, 0.5 * own_pitch()) : 0.0;
        for (const double spacing : finest) {
            tell("reference at " + in_mm(spacing));
            const auto body = task_.bone_at(spacing);
            if (!body) continue;
            if (!go(*body, with_pitch(pitch), task_.way, reference_, error)) return false;
            plan_.reference = {.spacing = spacing, .pitch = pitch};
            plan_.reference_force = rms(reference_.force);
            plan_.reference_torque = rms(reference_.torque);
            if (reference_.removed > 0.0 && plan_.reference_force > 0.0) return true;
            error = "step `" + task_.step + "`: its tool meets no bone on its way, so there is nothing to plan. Give a goal of depth that lies in the bone.";
            return false;
        }
        error = "step `" + task_.step + "`: the bone cannot be made at " + in_mm(finest[2]) +
                " or finer, which plans are held against. Make the region around the axes smaller.";
        return false;
    }

    bool choose_spacing(std::string& error) {
        for (const double spacing : ladder) {
            if (spacing <= plan_.reference.spacing) break;
            if (spacing > task_.coarsest && spacing > *std::prev(std::end(ladder))) continue;
            tell("bone at " + in_mm(spacing));
            Choice choice{.spacing = spacing, .pitch = own_pitch()};
            auto body = task_.bone_at(spacing);
            choice.has_bone = body.has_value();
            if (body) {
                Met met;
                if (!go(*body, task_.setup, task_.way, met, error)) return false;
                choice.error = apart(met, reference_);
                whole_ = std::move(met);
                without_body_ = std::move(*body);
            }
            plan_.tried.push_back(choice);
            if (choice.has_bone) plan_.chosen = choice;
            if (choice.keeps(task_.accuracy)) break;
        }
        plan_.keeps_accuracy = plan_.chosen.keeps(task_.accuracy);
        without_ = task_.setup;
        if (plan_.chosen.spacing > 0.0) return true;
        error = "step `" + task_.step + "`: the bone can be made at no spacing from 0.125 to 1 mm.";
        return false;
    }

    bool choose_pitch(std::string& error) {
        if (!pitch_ || !plan_.keeps_accuracy) return true;
        for (const double times : pitch_steps) {
            Choice choice = plan_.chosen;
            choice.pitch = std::min(pitch_->coarsest, times * own_pitch());
            if (choice.pitch <= own_pitch()) continue;
            tell("elements " + std::to_string(static_cast<int>(times)) + " times as long");
            Met met;
            if (!go(without_body_, with_pitch(choice.pitch), task_.way, met, error)) return false;
            choice.error = apart(met, reference_);
            plan_.tried.push_back(choice);
            if (!choice.keeps(task_.accuracy)) continue;
            plan_.chosen = choice;
            whole_ = std::move(met);
            without_ = with_pitch(choice.pitch);
            return true;
        }
        return true;
    }

    bool choose_features(std::string& error) {
        const std::vector<Feature> features = features_of(without_, task_.tool, task_.force, without_body_);
        for (const Feature& feature : features) {
            tell("without " + feature.id);
            ToolSetup setup = without_;
            Body body = without_body_;
            feature.leave_out(setup, body);
            Met met;
            if (!go(body, setup, task_.way, met, error)) return false;
            plan_.features.push_back({feature.id, feature.help, apart(met, whole_), false});
        }
        if (!plan_.keeps_accuracy) return true;
        // Those that change least go first, as long as all that is left out together stays within the accuracy.
        std::vector<std::size_t> order(features.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return plan_.features[a].change.force < plan_.features[b].change.force;
        });
        for (const std::size_t i : order) {
            if (plan_.features[i].change.force > task_.accuracy.force) break;
            ToolSetup setup = without_;
            Body body = without_body_;
            features[i].leave_out(setup, body);
            Met met;
            if (!go(body, setup, task_.way, met, error)) return false;
            Choice choice = plan_.chosen;
            choice.error = apart(met, reference_);
            if (!choice.keeps(task_.accuracy)) continue;
            plan_.chosen = choice;
            plan_.features[i].is_left_out = true;
            without_ = setup;
            without_body_ = std::move(body);
        }
        return true;
    }

    const Task& task_;
    const Progress& progress_;
    std::optional<Pitch> pitch_;
    StepPlan plan_;
    Met reference_, whole_;  ///< whole: of what is chosen, before anything is left out
    ToolSetup without_;  ///< what is chosen so far
    Body without_body_;
};

}  // namespace

std::optional<StepPlan> plan_step(const Task& task, const Progress& progress, std::string& error) {
    return Planner(task, progress).plan(error);
}

}  // namespace kerf::plan
