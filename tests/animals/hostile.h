// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <utility>

#include "kerf/abi.h"

extern "C" __attribute__((visibility("hidden"))) const char kerf_how[];

/// The parts of hostile_plugin.cpp that further faults use.
namespace hostile {

/// Returns whether this library has the fault.
inline bool is(std::string_view fault) { return kerf_how == fault; }

/// Returns whether it has the fault at this function of a plugin: "crashes" at "resist" is `crashes_in_resist`.
inline bool does(std::string_view what, std::string_view place) {
    const std::string_view how = kerf_how;
    return how.size() == what.size() + 4 + place.size() && how.starts_with(what) && how.ends_with(place);
}

inline volatile int sink = 0;
inline bool has_misbehaved = false;

/// True at its first call.
inline bool is_first() { return !std::exchange(has_misbehaved, true); }

/// Uses up the stack if `depth` is not negative.
[[gnu::noinline]] inline int fall(int depth) { return depth < 0 ? sink : fall(depth + 1) + sink; }

struct State {
    double cut;
    double rate[6];  // of the tool in the last tick
};

/// The tables of the plugin, before the host sees them.
struct Tables {
    kerf_entry& entry;
    kerf_force& force;
};

// Further faults. They do nothing in a library that links none (bench/strangers/modes has them).
void misbehave_further(std::string_view place);
void shape_further(kerf_tool_shape* out);
void begin_further(void* state);
kerf_status resist_further(const kerf_tick_in* in, const void* state, kerf_law* law);
kerf_status commit_further(void* state, kerf_commit_out* out);
void fill_further(const Tables& tables);

}  // namespace hostile
