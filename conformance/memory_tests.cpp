// SPDX-License-Identifier: Apache-2.0
// Level 3: what memory a law reads and writes. A misuse crashes, and the sandbox names the memory.
#include <vector>

#include "conformance/law_walk.h"
#include "conformance/test_groups.h"

namespace kerf::conformance {

namespace {

void walk_with(Examination& exam, const Guards& guards) {
    WalkSettings settings;
    settings.guards = guards;
    walk(exam, settings, short_path(), {});
}
void keeps_inputs(Examination& exam) { walk_with(exam, {.inputs = true}); }
void keeps_within_inputs(Examination& exam) { walk_with(exam, {.input_ends = true}); }
void keeps_within_outputs(Examination& exam) { walk_with(exam, {.output_ends = true}); }
void keeps_within_state(Examination& exam) { walk_with(exam, {.state_end = true}); }

void keeps_no_pointer(Examination& exam) {
    constexpr int most = 60;  // moves, each of a dozen pages
    WalkSettings settings;
    settings.guards = {.input_ends = true, .output_ends = true};
    int n = 0, moves = 0;
    const AtPose move = [&](LawWalk& law) {
        if (++n % 10 == 0 && moves++ < most) law.move_memory();
        return true;
    };
    walk(exam, settings, short_path(), move, [&](LawWalk& law) {
        if (n % 10 == 5 && moves++ < most) law.move_memory();
        return true;
    });
}

constexpr Test tests[] = {
    {"law.inputs", 3, Scope::law, "It writes to none of its inputs.", &keeps_inputs, "law.answers"},
    {"law.input_ends", 3, Scope::law, "It reads nothing behind its inputs.", &keeps_within_inputs, "law.answers"},
    {"law.output_ends", 3, Scope::law, "It writes nothing behind its outputs.", &keeps_within_outputs, "law.answers"},
    {"law.state_end", 3, Scope::law, "It writes nothing behind its state.", &keeps_within_state, "law.answers"},
    {"law.pointers", 3, Scope::law, "It keeps no pointer from one call to the next.", &keeps_no_pointer,
     "law.input_ends"},
};

}  // namespace

std::span<const Test> memory_tests() { return tests; }

}  // namespace kerf::conformance
