// SPDX-License-Identifier: Apache-2.0
// Level 3: what a law answers.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "conformance/law_walk.h"
#include "conformance/parameter_sets.h"
#include "conformance/test_groups.h"
#include "core/haptics/law/channel.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

void answers(Examination& exam) { walk(exam, {}, eventful_path(), {}); }

void is_finite(Examination& exam) {
    walk(exam, {}, eventful_path(), [&](LawWalk& law) {
        if (const std::string fault = fault_of_numbers(law); !fault.empty()) exam.fail(fault);
        return !exam.has_failed();
    });
}

void is_sound(Examination& exam) {
    walk(exam, {}, eventful_path(), [&](LawWalk& law) {
        if (const std::string fault = fault_of_channels(law); !fault.empty()) exam.fail(fault);
        return !exam.has_failed();
    });
}

void numbers_its_channels(Examination& exam) {
    constexpr std::uint32_t first_of_host = 0xfffffe00u;
    walk(exam, {}, eventful_path(), [&](LawWalk& law) {
        const auto channels = law.channels();
        for (std::size_t i = 0; i < channels.size(); ++i) {
            if (channels[i].id >= first_of_host)
                exam.fail(name_of(channels[i], i) + " has an id from " + std::to_string(first_of_host) +
                          " on, which is the host's, " + law.where() + ".");
            for (std::size_t j = 0; j < i; ++j)
                if (channels[i].id == channels[j].id)
                    exam.fail(name_of(channels[i], i) + " has the id of channel " + std::to_string(j) + " too, " +
                              law.where() + ". The host filters each channel's force by its id.");
        }
        return !exam.has_failed();
    });
}

void is_silent_in_air(Examination& exam) {
    constexpr double silent = 1e-3;  // [N], [N·m]
    WalkSettings settings;
    settings.bone.shape = PlaneBone::Shape::air;
    walk(exam, settings, short_path(), [&](LawWalk& law) {
        std::vector<Vec6> rates(1);
        for (std::size_t i = 0; i < 6; ++i)
            for (const double speed : {-0.01, 0.01}) {
                rates.emplace_back();
                rates.back()[i] = speed;
            }
        for (const Vec6& rate : rates) {
            const Vec6 force = law.force_at(rate);
            for (std::size_t i = 0; i < 6; ++i)
                if (!(std::abs(force[i]) <= silent))
                    exam.fail(std::string("In air it makes a ") + (i < 3 ? "force" : "torque") + " of " +
                              number(force[i]) + (i < 3 ? " N" : " N·m") + " on the tool, " + law.where() +
                              ", expected none.");
        }
        return !exam.has_failed();
    });
}

// ---- continuity ---------------------------------------------------------------------------------------------------

/// A tool whose state is kept, put along a line: its force at one rate.
struct Line {
    const char* name;
    double tilt;
    Vec6 rate;  ///< tool frame
};

void is_continuous(Examination& exam) {
    constexpr double from = -0.3e-3, to = 0.4e-3, step = 1e-6, jump = 0.05;  // [m], [N]
    constexpr Line lines[] = {
        {"at rest", 0.0, {}},
        {"fed at 2 mm/s", 0.0, {0, 0, 2e-3, 0, 0, 0}},
        {"moved sideways at 2 mm/s", 0.0, {2e-3, 0, 0, 0, 0, 0}},
        {"fed at 2 mm/s, 25° askew", 25.0 * pi / 180.0, {0, 0, 2e-3, 0, 0, 0}},
    };
    for (const bool is_running : {true, false}) {
        WalkSettings settings;
        if (!is_running) settings.drives = drives_at_rest(*exam.subject->tool);
        LawWalk law(*exam.subject, settings);
        if (!law.refusal().empty()) return exam.skip(law.refusal());
        law.begin(at_depth(from));
        law.run_up();
        for (const Line& line : lines) {
            const auto force = [&](double depth) {
                law.place(at_depth(depth, line.tilt));
                return law.resist() == KERF_OK ? law.force_at(line.rate) : Vec6{};
            };
            const auto apart = [](const Vec6& a, const Vec6& b) {
                return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                                 (a[2] - b[2]) * (a[2] - b[2]));
            };
            double worst = 0.0, at = from;
            Vec6 last = force(from);
            for (double depth = from + step; depth < to; depth += step) {
                const Vec6 now = force(depth);
                if (apart(last, now) > worst) worst = apart(last, now), at = depth - step;
                last = now;
            }
            // A steep slope becomes less in a shorter step; a jump stays.
            double low = at, high = at + step;
            for (int halving = 0; halving < 40 && worst > jump; ++halving) {
                const double middle = 0.5 * (low + high);
                const Vec6 left = force(low), centre = force(middle), right = force(high);
                (apart(left, centre) >= apart(centre, right) ? high : low) = middle;
                worst = apart(force(low), force(high));
            }
            if (worst > jump)
                return exam.fail(std::string("Its force jumps by ") + number(worst) + " N where the tip is " +
                                 number(1e3 * low) + " mm below the face, " + line.name +
                                 (is_running ? "" : ", with its drives at rest") +
                                 ". Let what begins there begin at nothing.");
        }
    }
}

// ---- after the balance --------------------------------------------------------------------------------------------

void writes_its_signals(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    walk(exam, {}, eventful_path(), {}, [&](LawWalk& law) {
        for (std::uint32_t i = 0; i < force.signal_count; ++i)
            if (!std::isfinite(law.signals()[i]))
                exam.fail("`commit` leaves the signal `" + std::string(force.signals[i].id) +
                          "` unwritten, or writes no finite number, " + law.where() + ".");
        return !exam.has_failed();
    });
}

void requests_known_actions(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    walk(exam, {}, eventful_path(), {}, [&](LawWalk& law) {
        const kerf_commit_out& out = law.committed();
        if (out.action_count > KERF_MAX_ACTIONS) {
            exam.fail("`commit` requests " + std::to_string(out.action_count) + " actions, expected at most " +
                      std::to_string(KERF_MAX_ACTIONS) + ", " + law.where() + ".");
            return false;
        }
        for (std::uint32_t i = 0; i < out.action_count; ++i) {
            const kerf_action action = out.action[i];
            if (action.kind < KERF_ACTION_CUT || action.kind > KERF_ACTION_EVENT)
                exam.fail("`commit` requests an action of kind " + std::to_string(action.kind) +
                          ", expected 1 (cut), 2 (hold), 3 (release) or 4 (event), " + law.where() + ".");
            else if (action.kind == KERF_ACTION_CUT && action.value > KERF_CUT_THREAD)
                exam.fail("`commit` cuts with solid " + std::to_string(action.value) +
                          ", expected 0 (what cuts) or 1 (the cylinder over the thread), " + law.where() + ".");
            else if (action.kind == KERF_ACTION_CUT && action.value == KERF_CUT_THREAD && !law.outline().has_thread())
                exam.fail("`commit` cuts with the cylinder over the thread, and the tool has none, " + law.where() +
                          ".");
            else if (action.kind == KERF_ACTION_EVENT && action.value >= force.event_count)
                exam.fail("`commit` reports event number " + std::to_string(action.value) + ", and it declares " +
                          std::to_string(force.event_count) + ", " + law.where() + ".");
        }
        if (!law.has_kept_thread())
            exam.fail("`commit` moves the host's pointer `thread`, " + law.where() + ".");
        else if (out.thread_count > 1)
            exam.fail("`commit` leaves " + std::to_string(out.thread_count) + " threads, expected 0 or 1, " +
                      law.where() + ".");
        else if (const char* field = out.thread_count == 1 ? fault_of(law.thread()) : nullptr; field != nullptr)
            exam.fail("`commit` leaves a thread that the host cannot keep: its `" + std::string(field) +
                      "` is out of range, " + law.where() + ".");
        return !exam.has_failed();
    });
}

// ---- what it declares ---------------------------------------------------------------------------------------------

struct Most {
    std::uint32_t channels = 0, points = 0, queries = 0;
    std::string channels_at, points_at, queries_at;
};

/// The largest counts of one `resist`, for the defaults and with each parameter at either end.
Most max_of(Examination& exam) {
    Most most;
    const auto take = [](std::uint32_t now, const LawWalk& law, std::uint32_t& largest, std::string& at) {
        if (now > largest) largest = now, at = law.where();
    };
    const auto look = [&](LawWalk& law) {
        const PlaneBone::Counts counts = law.bone().take_counts();
        take(static_cast<std::uint32_t>(law.channels().size()), law, most.channels, most.channels_at);
        take(counts.points, law, most.points, most.points_at);
        take(counts.queries, law, most.queries, most.queries_at);
        return true;
    };
    const auto forget = [](LawWalk& law) {
        static_cast<void>(law.bone().take_counts());
        return true;
    };
    walk(exam, {}, eventful_path(), look, forget);
    for (const ParameterSet& set : parameter_sets(*exam.subject->force, 0)) {
        WalkSettings settings;
        settings.force_parameters = set.values;
        walk(exam, settings, coarse_path(), look, forget);
    }
    for (const ParameterSet& set : parameter_sets(*exam.subject->tool, 0)) {
        Examination one(exam.path, exam.subject);  // a tool may refuse these parameters
        WalkSettings settings;
        settings.tool_parameters = set.values;
        walk(one, settings, coarse_path(), look, forget);
    }
    return most;
}

void keeps_to(Examination& exam, const char* what, std::uint32_t declared, std::uint32_t counted,
              const std::string& at) {
    if (declared == 0)
        exam.warn("It does not declare `" + std::string(what) + "`. One `resist` takes up to " +
                  std::to_string(counted) + " here: write `work({." + what + " = " + std::to_string(counted) +
                  "})` in its description.");
    else if (counted > declared)
        exam.fail("One `resist` takes " + std::to_string(counted) + " " + what + " " + at + ", and it declares " +
                  std::to_string(declared) + ".");
    else
        exam.note(std::to_string(counted) + " of " + std::to_string(declared) + " declared");
}

void keeps_to_its_channels(Examination& exam) {
    const Most most = max_of(exam);
    keeps_to(exam, "channels", exam.subject->force->force->max_channels, most.channels, most.channels_at);
}
void keeps_to_its_points(Examination& exam) {
    const Most most = max_of(exam);
    keeps_to(exam, "points", exam.subject->force->force->max_points, most.points, most.points_at);
}
void keeps_to_its_queries(Examination& exam) {
    const Most most = max_of(exam);
    keeps_to(exam, "queries", exam.subject->force->force->max_queries, most.queries, most.queries_at);
}

constexpr Test tests[] = {
    {"law.answers", 3, Scope::law, "Its functions return, and without an error.", &answers, "describe.tables", 2},
    {"law.finite", 3, Scope::law, "Every number of the law is finite.", &is_finite, "law.answers"},
    {"law.sound", 3, Scope::law, "Every channel is sound, so its force never falls as the rate grows.", &is_sound,
     "law.answers"},
    {"law.ids", 3, Scope::law, "Every channel has an id of its own.", &numbers_its_channels, "law.sound"},
    {"law.air", 3, Scope::law, "There is no force in air.", &is_silent_in_air, "law.sound"},
    {"law.continuous", 3, Scope::law, "The force does not jump where the tool meets bone.", &is_continuous, "law.sound",
     6},
    {"law.signals", 3, Scope::law, "Every signal is written in each tick.", &writes_its_signals, "law.answers"},
    {"law.actions", 3, Scope::law, "It requests actions, leaves threads and reports events that can be.",
     &requests_known_actions, "law.answers"},
    {"law.channels", 3, Scope::law, "It uses no more channels than it declares.", &keeps_to_its_channels, "law.sound",
     6},
    {"law.points", 3, Scope::law, "It queries no more points than it declares.", &keeps_to_its_points, "law.sound", 6},
    {"law.queries", 3, Scope::law, "It makes no more queries than it declares.", &keeps_to_its_queries, "law.sound", 6},
};

}  // namespace

std::span<const Test> law_tests() { return tests; }

std::string fault_of_numbers(const LawWalk& law) {
    const auto channels = law.channels();
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const kerf_channel& c = channels[i];
        const auto fault = [&](const std::string& field, double value) {
            return name_of(c, i) + ": `" + field + "` is " + number(value) + ", expected a finite number, " +
                   law.where() + ".";
        };
        for (std::size_t k = 0; k < 6; ++k) {
            if (!std::isfinite(c.d[k])) return fault("d[" + std::to_string(k) + "]", c.d[k]);
            if (!std::isfinite(c.follow[k])) return fault("follow[" + std::to_string(k) + "]", c.follow[k]);
        }
        const std::pair<const char*, double> fields[] = {{"tau", c.tau}, {"w", c.w}, {"eta", c.eta},    {"gap", c.gap},
                                                         {"k", c.k},     {"b", c.b}, {"delta", c.delta}};
        for (const auto& [name, value] : fields)
            if (!std::isfinite(value)) return fault(name, value);
    }
    for (std::size_t k = 0; k < 6; ++k)
        if (!std::isfinite(law.law().wrench[k]))
            return "`wrench[" + std::to_string(k) + "]` is " + number(law.law().wrench[k]) +
                   ", expected a finite number, " + law.where() + ".";
    return {};
}

std::string fault_of_channels(const LawWalk& law) {
    if (law.law().count > KERF_MAX_CHANNELS)
        return "Its law has " + std::to_string(law.law().count) + " channels, expected at most " +
               std::to_string(KERF_MAX_CHANNELS) + ", " + law.where() + ".";
    const auto channels = law.channels();
    for (std::size_t i = 0; i < channels.size(); ++i)
        if (const ChannelFault fault = fault_of(channels[i]); fault.field != nullptr)
            return name_of(channels[i], i) + ": `" + fault.field + "` is " + number(fault.value) + ", expected " +
                   fault.expected + ", " + law.where() + ".";
    return {};
}

}  // namespace kerf::conformance
