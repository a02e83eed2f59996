// SPDX-License-Identifier: Apache-2.0
// `kerf rehearse`.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/program.h"
#include "app/read_scene.h"
#include "app/shown_run.h"
#include "app/standard_streams.h"
#include "run/cheats.h"
#include "run/run_procedure.h"

namespace kerf::app {

namespace {

std::string expectation_of(const documents::Rehearsal& rehearsal) {
    if (rehearsal.expect != "fail") return rehearsal.expect;
    return "fail by `" + rehearsal.expect_limit + (rehearsal.expects_others ? "`, and others may break" : "` alone") +
           (rehearsal.expect_step.empty() ? "" : ", in the step `" + rehearsal.expect_step + "`");
}

std::string ending_of(const session::RunSummary& summary) {
    std::string text = to_text(summary.verdict) + formatted(", score %.0f", std::round(summary.score));
    for (const auto& reason : summary.reasons) text += "\n            " + text::shown(reason);
    return text;
}

/// Runs a hand of the scene's procedure. Prints why it could not, and returns that code; `exit_pass` if it ran.
ExitCode run_hand(const run::Scene& scene, const std::string& hand, const Environment& with, run::RunOutcome& outcome) {
    run::RunRequest request;
    request.rehearsal = hand;
    const Interruption interruption;
    ShownRun shown_run(interruption);
    request.observers = {&shown_run};
    outcome = run::run_procedure(scene, with.plugins, request);
    if (outcome.was_interrupted) return complain("interrupted", exit_fault);
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    return exit_pass;
}

/// Numbers of steps and limits.
struct Gaps {
    int uncovered = 0;  ///< that no rehearsal ends or breaks, and guards that one breaks
    int guards = 0;     ///< limits that, as the procedure states, no hand breaks
};

/// What the rehearsals of a procedure have triggered.
class Coverage {
public:
    void add(const run::RunOutcome& outcome) {
        for (std::size_t s = 0; s < outcome.broken_limits.size(); ++s) {
            if (outcome.summary.steps[s].done) done_.insert(s);
            for (const std::size_t limit : outcome.broken_limits[s]) broken_.emplace(s, limit);
        }
    }
    /// Prints the steps that no rehearsal ended, the limits that none broke, and the guards. Returns their numbers.
    /// Leaves out events that spoil a tool: no procedure writes them.
    Gaps print_gaps(const documents::Procedure& procedure) const {
        Gaps gaps;
        for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
            const documents::Step& step = procedure.steps[s];
            if (!done_.contains(s)) {
                print("  no rehearsal ends the step `" + step.id + "`\n");
                ++gaps.uncovered;
            }
            for (std::size_t i = 0; i < step.limits.size(); ++i) {
                const documents::Limit& limit = step.limits[i];
                if (limit.quantity == "damage") continue;
                const std::string name = "the limit `" + limit.name() + "` of the step `" + step.id + "`";
                const bool is_broken = broken_.contains({s, i}), is_guard = !limit.guard.empty();
                if (is_guard && is_broken) {
                    print("  a rehearsal breaks " + name + ", so its `guard:` is not true: remove the key\n");
                    ++gaps.uncovered;
                } else if (is_guard) {
                    print("  a guard is " + name + ": " + text::shown(limit.guard) + "\n");
                    ++gaps.guards;
                } else if (!is_broken) {
                    print("  no rehearsal breaks " + name + ": " + text::shown(limit.reason) + "\n");
                    ++gaps.uncovered;
                }
            }
        }
        return gaps;
    }

private:
    std::set<std::size_t> done_;
    std::set<std::pair<std::size_t, std::size_t>> broken_;  ///< step, limit
};

ExitCode rehearse_file(const std::string& file, const RehearseOptions& options, const Environment& with) {
    const auto scene = read_scene(file, options, with);
    if (!scene) return exit_bad_input;
    if (scene->procedure.rehearsals.empty())
        return complain(file + " has no rehearsals. Add one under `rehearsals:`.", exit_bad_input);

    int as_expected = 0;
    Coverage coverage;
    for (const auto& rehearsal : scene->procedure.rehearsals) {
        run::RunOutcome outcome;
        if (const ExitCode code = run_hand(*scene, rehearsal.id, with, outcome); code != exit_pass) return code;
        print(rehearsal.id + ": " + (outcome.is_as_expected ? "ended as expected" : "NOT AS EXPECTED") +
              "\n  expected  " + expectation_of(rehearsal) + "\n  ended     " + ending_of(outcome.summary) + "\n");
        as_expected += outcome.is_as_expected;
        coverage.add(outcome);
    }
    const int count = static_cast<int>(scene->procedure.rehearsals.size());
    print(file + formatted(": %d of %d rehearsals ended as expected\n", as_expected, count));
    int uncovered = 0;
    if (options.is_with_coverage) {
        const Gaps gaps = coverage.print_gaps(scene->procedure);
        uncovered = gaps.uncovered;
        print(file + formatted(": %d steps and limits are not covered", gaps.uncovered) +
              (gaps.guards > 0 ? formatted(", %d are guards\n", gaps.guards) : "\n"));
    }
    return as_expected == count && uncovered == 0 ? exit_pass : exit_not_passed;
}

/// Runs the standing bad hands against a procedure. None may pass.
ExitCode cheat_file(const std::string& file, const RehearseOptions& options, const Environment& with) {
    auto scene = read_scene(file, options, with);
    if (!scene) return exit_bad_input;
    const std::vector<run::Cheat> cheats = run::cheats_of(scene->procedure, with.plugins.catalog());
    if (cheats.empty())
        return complain(file + " has no rehearsal that expects to pass, of which a bad hand could be made. Add one "
                               "under `rehearsals:`, with `expect: pass`.",
                        exit_bad_input);
    int passing = 0, run_count = 0;
    for (const run::Cheat& cheat : cheats) {
        print(cheat.id + ": " + cheat.strength + "\n");
        if (!cheat.why_not.empty()) {
            print("  does not apply: " + cheat.why_not + "\n");
            continue;
        }
        scene->procedure.rehearsals.push_back(cheat.rehearsal);
        run::RunOutcome outcome;
        if (const ExitCode code = run_hand(*scene, cheat.rehearsal.id, with, outcome); code != exit_pass) return code;
        const bool passes = outcome.summary.verdict == session::Verdict::pass;
        print(std::string("  ") + (passes ? "PASSES" : "fails") + ": " + ending_of(outcome.summary) + "\n");
        passing += passes;
        ++run_count;
    }
    print(file + formatted(": %d of %d bad hands pass\n", passing, run_count));
    return passing == 0 ? exit_pass : exit_not_passed;
}

}  // namespace

namespace commands {

ExitCode rehearse(const RehearseOptions& options, const Environment& with) {
    if (options.is_with_cheats && options.is_with_coverage)
        return complain("`--coverage` is of the rehearsals, which `--cheats` does not run. Write one of both.",
                        exit_bad_input);
    ExitCode worst = exit_pass;
    for (const auto& file : options.procedures)
        worst = std::max(worst,
                         options.is_with_cheats ? cheat_file(file, options, with) : rehearse_file(file, options, with));
    return worst;
}

}  // namespace commands
}  // namespace kerf::app
