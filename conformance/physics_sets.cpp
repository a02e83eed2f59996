// SPDX-License-Identifier: Apache-2.0
// Level 4: a law in random sets of all its parameters and of its tool's, for size.
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "conformance/parameter_sets.h"
#include "conformance/sweep.h"
#include "conformance/test_groups.h"

namespace kerf::conformance {

namespace {

constexpr int set_count = 12;

/// Values of the parameters of a tool and its law.
struct Values {
    std::vector<double> tool, force;
};

/// The last sets of `parameter_sets`, which are spread over all ranges.
std::vector<ParameterSet> random_sets(const kerf_component& component) {
    std::vector<ParameterSet> sets = parameter_sets(component, set_count);
    if (sets.size() > set_count) sets.erase(sets.begin(), sets.end() - set_count);
    sets.resize(set_count, sets.back());  // of a component without parameters there is one
    return sets;
}

std::vector<double> between(const kerf_component& component, const std::vector<double>& to, double part) {
    std::vector<double> values = default_parameters(component);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = is_count(component.params[i]) ? to[i] : values[i] + part * (to[i] - values[i]);
    return values;
}

/// From the defaults, with the counts of a random set, to that set.
Sweep towards(const Subject& subject, const Values& to, const std::string& name) {
    return {.subject = subject,
            .settings =
                [&subject, to](double part) {
                    WalkSettings settings = solid_bone();
                    settings.tool_parameters = between(*subject.tool, to.tool, part);
                    settings.force_parameters = between(*subject.force, to.force, part);
                    return settings;
                },
            .named = [name](double part) { return number(100.0 * part) + " % along the line to " + name; }};
}

/// Where the force helps a motion of the running tool, in a sentence; empty where bone resists all.
std::string help_in(const Sweep& sweep) {
    LawProbe probe(sweep.subject, sweep.settings(1.0));
    if (!probe.refusal().empty()) return {};
    const LawProbe::Help help = probe.largest_help();
    constexpr double allowed = 0.25;  // [–] of a part of a turn: the force of a large runout turns with the shaft
    if (help.newtons <= allowed * help.largest) return {};
    return "With " + sweep.named(1.0) + ", moved along " + name_of_direction(help.along) +
           " in solid bone, its force is " + in_newtons(help.force) + ": it helps with " + number(help.newtons) +
           " N, expected none.";
}

void keeps_its_size_in_random_sets(Examination& exam) {
    const Subject& subject = *exam.subject;
    const std::vector<ParameterSet> tools = random_sets(*subject.tool), forces = random_sets(*subject.force);
    std::vector<double> parts;
    for (int i = 0; i <= 8; ++i) parts.push_back(0.125 * i);
    for (std::size_t i = 0; i < set_count; ++i) {
        const ParameterSet& force = forces[(7 * i + 2) % set_count];  // not in step with the tool's
        const Sweep sweep = towards(subject, {tools[i].values, force.values},
                                    "the tool with " + tools[i].name + " and the law with " + force.name);
        if (const std::string text = jump_along(sweep, parts); !text.empty()) return exam.fail(text);
        if (const std::string text = help_in(sweep); !text.empty()) return exam.fail(text);
    }
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.sets", 4, Scope::law, "In random sets of parameters its force does not jump, and helps no motion.",
     &keeps_its_size_in_random_sets, "law.sound", long_time},
};

}  // namespace

std::span<const Test> physics_set_tests() { return tests; }

}  // namespace kerf::conformance
