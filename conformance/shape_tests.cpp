// SPDX-License-Identifier: Apache-2.0
// Level 2: a tool's geometry over the ranges of its parameters.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "conformance/law_walk.h"
#include "conformance/parameter_sets.h"
#include "conformance/subject.h"
#include "conformance/test_groups.h"
#include "core/plugin/guarded_memory.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/plugin_call.h"

namespace kerf::conformance {

namespace {

constexpr std::uint32_t capacity = 64;  // as the host offers

/// One call of `shape`, with what it wrote.
struct Shape {
    std::vector<kerf_profile_point> points = std::vector<kerf_profile_point>(capacity);
    kerf_tool_shape shape{};
    kerf_status status = KERF_OK;
};
Shape shape_of(const kerf_component& tool, const std::vector<double>& parameters) {
    Shape made;
    made.shape.size = sizeof made.shape;
    made.shape.profile = made.points.data();
    made.shape.profile_capacity = capacity;
    made.shape.kind = KERF_SOLID_REVOLUTION;
    made.status = call_shape(tool, parameters.data(), made.shape);
    return made;
}

bool is_same(const Shape& a, const Shape& b) {
    kerf_tool_shape x = a.shape, y = b.shape;
    x.profile = y.profile = nullptr;
    return a.status == b.status && std::memcmp(&x, &y, sizeof x) == 0 &&
           std::memcmp(a.points.data(), b.points.data(), capacity * sizeof(kerf_profile_point)) == 0;
}

ToolSetup with(const Subject& subject, const std::vector<double>& parameters) {
    ToolSetup setup = subject.setup();
    setup.tool_parameters = parameters;
    return setup;
}

void is_solid_by_default(Examination& exam) {
    ToolOutline outline;
    std::string error;
    if (!outline_of(exam.subject->setup(), outline, error)) exam.fail("With the defaults, " + error);
}

void is_solid_or_refused(Examination& exam) {
    const kerf_component& tool = *exam.subject->tool;
    int refused = 0;
    const auto sets = parameter_sets(tool, 100);
    for (const ParameterSet& set : sets) {
        const Shape made = shape_of(tool, set.values);
        if (made.status == KERF_OUT_OF_RANGE) {
            ++refused;
            continue;
        }
        if (made.status != KERF_OK)
            return exam.fail("`shape` " + name_of_status(made.status) + " or -2 (KERF_OUT_OF_RANGE), with " + set.name +
                             ".");
        ToolOutline outline;
        std::string error;
        if (!outline_of(with(*exam.subject, set.values), outline, error))
            return exam.fail("With " + set.name + ", " + error +
                             " Return KERF_OUT_OF_RANGE with a refusal where parameters do not go together.");
    }
    exam.note(std::to_string(sets.size()) + " sets of parameters, " + std::to_string(refused) + " refused");
}

void refuses_in_words(Examination& exam) {
    const kerf_component& tool = *exam.subject->tool;
    for (const ParameterSet& set : parameter_sets(tool, 100)) {
        const Shape made = shape_of(tool, set.values);
        if (made.status != KERF_OUT_OF_RANGE) continue;
        const char* const end = std::find(std::begin(made.shape.refusal), std::end(made.shape.refusal), '\0');
        const std::string words(made.shape.refusal, end);
        if (end == std::end(made.shape.refusal))
            return exam.fail("With " + set.name + ", its refusal does not end with NUL.");
        if (words.empty())
            return exam.fail("With " + set.name +
                             ", it refuses without a word. Write to `refusal` which parameters do not go together, "
                             "their values and what is needed.");
        if (!is_utf8(words) || !is_plain(words))
            return exam.fail("With " + set.name + ", its refusal is not plain UTF-8: " + quoted_plain(words) + ".");
    }
}

void is_pure(Examination& exam) {
    const kerf_component& tool = *exam.subject->tool;
    const auto sets = parameter_sets(tool, 20);
    std::vector<Shape> first;
    for (const ParameterSet& set : sets) first.push_back(shape_of(tool, set.values));
    for (std::size_t i = sets.size(); i-- > 0;)
        if (!is_same(shape_of(tool, sets[i].values), first[i]))
            return exam.fail(
                "With " + sets[i].name +
                ", `shape` writes another outline when it is called again, after others. It must depend on "
                "its parameters alone.");
}

void keeps_within_capacity(Examination& exam) {
    const kerf_component& tool = *exam.subject->tool;
    const std::vector<double> parameters = exam.subject->setup().tool_parameters;
    const std::uint32_t needed = shape_of(tool, parameters).shape.profile_count;
    for (std::uint32_t room = 1; room < std::min(needed, capacity); ++room) {
        GuardedMemory memory;
        kerf_tool_shape shape{};
        shape.size = sizeof shape;
        shape.kind = KERF_SOLID_REVOLUTION;
        shape.profile_capacity = room;
        shape.profile = static_cast<kerf_profile_point*>(
            memory.allocate(room * sizeof(kerf_profile_point), alignof(kerf_profile_point),
                            "it wrote more points than `profile_capacity`"));
        const kerf_status status = call_shape(tool, parameters.data(), shape);
        if (status == KERF_OK && shape.profile_count > room)
            return exam.fail("With room for " + std::to_string(room) + " points it claims to have written " +
                             std::to_string(shape.profile_count) + ". Return KERF_CAPACITY.");
        if (status == KERF_OK)
            return exam.fail("With room for " + std::to_string(room) + " of its " + std::to_string(needed) +
                             " points `shape` returns 0 (KERF_OK) and another outline. Return KERF_CAPACITY.");
    }
}

void reads_only_its_parameters(Examination& exam) {
    const std::vector<double> parameters = exam.subject->setup().tool_parameters;
    GuardedMemory memory;
    const double* const guarded = memory.copy(parameters.data(), parameters.size(),
                                              "it read beyond the end of `params`; it declares fewer parameters");
    memory.make_read_only("it wrote to `params`, which is the host's");
    std::vector<kerf_profile_point> points(capacity);
    kerf_tool_shape shape{};
    shape.size = sizeof shape;
    shape.profile = points.data();
    shape.profile_capacity = capacity;
    shape.kind = KERF_SOLID_REVOLUTION;
    static_cast<void>(call_shape(*exam.subject->tool, guarded, shape));
}

void is_as_large_as_a_tool(Examination& exam) {
    constexpr double shortest = 3e-3, longest = 1.0, thinnest = 0.05e-3;  // [m]
    ToolOutline outline;
    std::string error;
    if (!outline_of(exam.subject->setup(), outline, error)) return exam.skip(error);
    const double length = outline.profile.front().z - outline.profile.back().z;
    double radius = 0.0;
    for (const kerf_profile_point& point : outline.profile) radius = std::max(radius, point.radius);
    if (!(length >= shortest && length <= longest))
        return exam.fail("By default it is " + number(1e3 * length) + " mm long, expected " + number(1e3 * shortest) +
                         " mm … " + number(1e3 * longest) + " mm. Lengths are in metres.");
    if (radius < thinnest)
        return exam.fail("By default its largest radius is " + number(1e3 * radius) + " mm, expected at least " +
                         number(1e3 * thinnest) + " mm. Lengths are in metres.");
    exam.note(number(1e3 * length) + " mm long, " + number(2e3 * radius) + " mm wide");
}

void weighs_as_a_tool(Examination& exam) {
    ToolOutline outline;
    std::string error;
    if (!outline_of(exam.subject->setup(), outline, error)) return exam.skip(error);
    const Inertia& inertia = outline.inertia;
    if (inertia.mass == 0.0) return exam.note("no mass");
    constexpr double lightest = 1e-3, heaviest = 5.0;  // [kg]
    if (inertia.mass < lightest || inertia.mass > heaviest)
        return exam.fail("By default its mass is " + number(inertia.mass) + " kg, expected " + number(lightest) +
                         " kg … " + number(heaviest) + " kg.");
    if (inertia.gyration < 1e-3 || inertia.gyration > 0.5)
        return exam.fail("By default its radius of gyration is " + number(1e3 * inertia.gyration) +
                         " mm, expected 1 mm … 500 mm.");
    if (inertia.centre_z > 0.0)
        exam.fail("By default its centre of mass lies " + number(1e3 * inertia.centre_z) +
                  " mm in front of its tip. `centre_z` points out of the tip, so it is negative.");
}

constexpr Test tests[] = {
    {"shape.default", 2, Scope::tool, "Its defaults make a solid.", &is_solid_by_default, "describe.tables"},
    {"shape.range", 2, Scope::tool, "All parameters in their ranges make a solid, or are refused.",
     &is_solid_or_refused, "shape.default"},
    {"shape.refusal", 2, Scope::tool, "It says in words why it refuses parameters.", &refuses_in_words,
     "shape.default"},
    {"shape.pure", 2, Scope::tool, "The same parameters make the same outline.", &is_pure, "shape.default"},
    {"shape.capacity", 2, Scope::tool, "It writes no more points than it has room for.", &keeps_within_capacity,
     "shape.default"},
    {"shape.parameters", 2, Scope::tool, "It reads its own parameters alone and writes none.",
     &reads_only_its_parameters, "shape.default"},
    {"shape.size", 2, Scope::tool, "It is as large as a tool.", &is_as_large_as_a_tool, "shape.default"},
    {"shape.mass", 2, Scope::tool, "It weighs as much as a tool.", &weighs_as_a_tool, "shape.default"},
};

}  // namespace

std::span<const Test> shape_tests() { return tests; }

}  // namespace kerf::conformance
