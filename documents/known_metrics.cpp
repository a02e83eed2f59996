// SPDX-License-Identifier: Apache-2.0
#include "documents/known_metrics.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "documents/names.h"
#include "documents/read_instruments.h"
#include "documents/signal_need.h"
#include "kerf/units.hpp"
#include "text/quantity.h"

namespace kerf::documents {

namespace {

using namespace literals;

const text::QuantityNeed length{dimension::length, "mm", -500.0_mm, 500.0_mm};
const text::QuantityNeed angle{dimension::angle, "deg", -180.0_deg, 180.0_deg};
const text::QuantityNeed time{dimension::time, "s", 0.0, 3600.0_s};
const text::QuantityNeed part{dimension::none, "%", -1.0, 100.0};
const text::QuantityNeed volume{dimension::volume, "mm3", -1e-3, 1e-3};
const text::QuantityNeed force{dimension::force, "N", 0.0, 10000.0_N};
const text::QuantityNeed torque{dimension::torque, "N m", 0.0, 1e6_Nmm};
const text::QuantityNeed speed{dimension::speed, "mm/s", 0.0, 500.0_mm_per_s};

struct Named {
    const char* name;
    const text::QuantityNeed* need;
    const char* quantity = nullptr;  ///< measured only for a goal or limit on it; null: always
};
/// Metrics of a step.
const std::array<Named, 27> of_step{{{"depth", &length},
                                     {"offset", &length},
                                     {"moved", &length},
                                     {"time-in-air", &time},
                                     {"depth-in-air", &length},
                                     {"plunge", &length},
                                     {"plunge.hand", &length},
                                     {"axis-in-bone", &part},
                                     {"hole-angle", &angle},
                                     {"entry-offset", &length},
                                     {"narrowest-offset", &length},
                                     {"end-offset", &length},
                                     {"excess-removal", &part},
                                     {"gertzbein-robbins", &length},
                                     {"heary", &length},
                                     {"thread-outside", &length},
                                     {"hole-offset", &length},
                                     {"hole-axis-angle", &angle},
                                     {"reduction-offset", &length},
                                     {"reduction-angle", &angle},
                                     {"removed-volume", &volume, "removed_volume"},
                                     {"tip-apex", &length, "tip_apex"},
                                     {"thrust", &force, "thrust"},
                                     {"duration", &time, "duration"},
                                     {"torque", &torque, "torque"},
                                     {"lateral-force", &force, "lateral_force"},
                                     {"speed", &speed, "speed"}}};

/// Metrics of a step with a plane.
const std::array<Named, 4> of_plane{
    {{"plane-angle", &angle}, {"plane-offset", &length}, {"flatness", &length}, {"removed", &volume}}};

/// Returns whether any goal or limit of a step fulfils a condition.
template <class Condition>
bool has_bound(const Step& step, const Condition& condition) {
    return std::any_of(step.goals.begin(), step.goals.end(), condition) ||
           std::any_of(step.limits.begin(), step.limits.end(), condition);
}
bool names(const Step& step, const std::string& quantity) {
    return has_bound(step, [&](const auto& bounded) { return bounded.quantity == quantity; });
}
/// Returns whether a goal with this end, or a limit with that one, is on a signal.
bool names_signal(const Step& step, const std::string& signal, std::optional<double> Bound::*goal_end,
                  std::optional<double> Bound::*limit_end) {
    const auto is_on_it = [&](const auto& bounded, auto end) {
        return bounded.signal.id == signal && bounded.bound.*end;
    };
    return std::any_of(step.goals.begin(), step.goals.end(),
                       [&](const Goal& goal) { return is_on_it(goal, goal_end); }) ||
           std::any_of(step.limits.begin(), step.limits.end(),
                       [&](const Limit& limit) { return is_on_it(limit, limit_end); });
}

std::string with_hyphens(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

}  // namespace

std::string breach_name(double diameter, bool is_one_of_several) {
    if (!is_one_of_several) return "breach";
    const std::string width = text::quantity_text(diameter, "mm");
    return "breach-" + width.substr(0, width.find(' ')) + "mm";
}

std::vector<KnownMetric> metrics_of(const Procedure& procedure, const ComponentCatalog& catalog) {
    std::vector<KnownMetric> known;
    for (const Step& step : procedure.steps) {
        const auto add = [&](const std::string& name, const text::QuantityNeed& need) {
            known.push_back({step.id + "." + name, step.id, need});
        };
        for (const Named& one : of_step)
            if (one.quantity == nullptr || names(step, one.quantity)) add(one.name, *one.need);
        if (!step.plane.empty())
            for (const Named& one : of_plane) add(one.name, *one.need);
        const auto breaches = std::count_if(step.limits.begin(), step.limits.end(),
                                            [](const Limit& limit) { return limit.quantity == "breach"; });
        for (const Limit& limit : step.limits) {
            if (limit.quantity == "breach") add(breach_name(limit.diameter, breaches > 1), length);
            if (!limit.zone.empty()) add("clearance." + limit.zone, length);
            if (limit.quantity == "axes_angle") add("axes-angle." + limit.landmark, angle);
        }
        const Instrument* used = find_id(procedure.instruments, step.instrument);
        if (const ComponentInfo* law = used != nullptr ? law_of(*used, catalog) : nullptr)
            for (const SignalInfo& signal : law->signals) {
                if (names_signal(step, signal.id, &Bound::at_least, &Bound::at_most))
                    add("signal." + signal.id, need_of(signal));
                if (names_signal(step, signal.id, &Bound::at_most, &Bound::at_least))
                    add("signal." + signal.id + ".least", need_of(signal));
                add("left." + with_hyphens(signal.id), need_of(signal));
            }
        for (const Measure& measure : procedure.measures)
            add("measure." + measure.id, measure.is_angle() ? angle : length);
    }
    for (const Measure& measure : procedure.measures)
        known.push_back({"measure." + measure.id + ".after", "", measure.is_angle() ? angle : length});
    return known;
}

}  // namespace kerf::documents
