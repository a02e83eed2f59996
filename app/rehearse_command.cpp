// SPDX-License-Identifier: Apache-2.0
// `kerf rehearse`.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/badges/used_plugins.h"
#include "app/commands.h"
#include "app/program.h"
#include "app/read_scene.h"
#include "app/run_hand.h"
#include "app/standard_streams.h"
#include "documents/made/read_request.h"
#include "documents/patch.h"
#include "run/cheats.h"
#include "run/run_procedure.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::app {

namespace {

constexpr std::uint32_t max_seeds = 1000;

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

ExitCode rehearse_file(const std::string& file, const RehearseOptions& options, const Environment& with,
                       UsedPlugins& used) {
    const auto scene = read_scene(file, options, with);
    if (!scene) return exit_bad_input;
    used.add(scene->procedure);
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
ExitCode cheat_file(const std::string& file, const RehearseOptions& options, const Environment& with,
                    UsedPlugins& used) {
    auto scene = read_scene(file, options, with);
    if (!scene) return exit_bad_input;
    used.add(scene->procedure);
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

struct Seeds {
    std::uint32_t first = 0, last = 0;
};

/// Reads "1..20" or "7".
std::optional<Seeds> read_seeds(const std::string& text) {
    const std::size_t dots = text.find("..");
    const auto number = [](std::string_view digits, std::uint32_t& value) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc{} && end == digits.data() + digits.size();
    };
    Seeds seeds;
    if (!number(std::string_view(text).substr(0, dots), seeds.first)) return std::nullopt;
    seeds.last = seeds.first;
    if (dots != std::string::npos && !number(std::string_view(text).substr(dots + 2), seeds.last)) return std::nullopt;
    if (seeds.last < seeds.first || seeds.last > documents::max_seed || seeds.last - seeds.first >= max_seeds)
        return std::nullopt;
    return seeds;
}

/// Returns whether an error may concern one person alone: a screw that does not fit the bone, or set dimensions that
/// contradict the drawn ones or the sex.
bool depends_on_person(const text::Diagnostic& d) {
    constexpr std::array codes{text::Code::screw_too_wide, text::Code::screw_too_long, text::Code::degenerate,
                               text::Code::out_of_range};
    return d.level != text::Diagnostic::Level::error ||
           std::any_of(codes.begin(), codes.end(), [&](text::Code code) { return d.code == text::code_text(code); });
}

/// Numbers of people by the result of the operation.
struct SeedCounts {
    int passing = 0, failing = 0, refused = 0;
};

/// Prints the row of a person whose bone the procedure does not suit. Returns `exit_bad_input` if the error concerns
/// the procedure itself.
ExitCode print_refusal(const std::string& head, const text::Diagnostics& diagnostics, SeedCounts& counts) {
    if (!std::all_of(diagnostics.begin(), diagnostics.end(), depends_on_person)) {
        print_error(to_text(diagnostics));
        return exit_bad_input;
    }
    const auto error = std::find_if(diagnostics.begin(), diagnostics.end(), [](const text::Diagnostic& d) {
        return d.level == text::Diagnostic::Level::error;
    });
    print(head + "refused          " + text::shown(error->message) + "\n");
    ++counts.refused;
    return exit_pass;
}

/// Runs a good hand on one person's bone, and prints its row.
ExitCode run_person(const std::string& head, const run::Scene& scene, const std::string& hand, const Environment& with,
                    SeedCounts& counts) {
    run::RunOutcome outcome;
    if (const ExitCode code = run_hand(scene, hand, with, outcome); code != exit_pass) return code;
    const session::RunSummary& summary = outcome.summary;
    const bool passes = summary.verdict == session::Verdict::pass;
    print(head + (passes ? "pass    " : "fail    ") + formatted("%6.0f  ", std::round(summary.score)) +
          scene.anatomy.title + "\n");
    for (const std::string& reason : summary.reasons) print(std::string(27, ' ') + text::shown(reason) + "\n");
    ++(passes ? counts.passing : counts.failing);
    return exit_pass;
}

/// Runs the first hand that expects to pass on the bones of several people, and prints a table. A person whose bone the
/// procedure does not suit counts as refused, which is no failure.
ExitCode seeds_file(const std::string& file, const Seeds& seeds, const RehearseOptions& options,
                    const Environment& with, UsedPlugins& used) {
    const auto documents = run::check_documents(request_of(file, options, with.here), with.plugins);
    if (!documents) {
        print_error(to_text(documents.diagnostics()));
        return exit_bad_input;
    }
    if (!documents->procedure.made)
        return complain("`--seeds` needs a bone to make: the anatomy of " + file +
                            " is a file. Write `anatomy: {make: vertebra, level: L3}` there, or add "
                            "`--set \"anatomy={make: vertebra, level: L3}\"`.",
                        exit_bad_input);
    const documents::Rehearsal* hand = run::find_good_hand(documents->procedure);
    if (hand == nullptr)
        return complain(file + " has no rehearsal that expects to pass. Add one under `rehearsals:`, with `expect: "
                               "pass`.",
                        exit_bad_input);
    used.add(documents->procedure);
    SeedCounts counts;
    print("    seed  verdict   score  bone\n");
    for (std::uint32_t seed = seeds.first; seed <= seeds.last; ++seed) {
        RehearseOptions of_seed = options;
        documents::override_setting(of_seed.settings, "anatomy.seed", std::to_string(seed));
        text::Diagnostics diagnostics;
        const auto scene = make_scene(file, of_seed, with).take(diagnostics);
        const std::string head = formatted("%8u  ", seed);
        if (scene && seed == seeds.first) print_error(to_text(diagnostics));
        const ExitCode code =
            scene ? run_person(head, *scene, hand->id, with, counts) : print_refusal(head, diagnostics, counts);
        if (code != exit_pass) return code;
    }
    print(file + formatted(": %d passed, %d failed, %d refused before the run\n", counts.passing, counts.failing,
                           counts.refused));
    return counts.failing == 0 && counts.passing > 0 ? exit_pass : exit_not_passed;
}

}  // namespace

namespace commands {

ExitCode rehearse(const RehearseOptions& options, const Environment& with) {
    if (options.is_with_cheats && options.is_with_coverage)
        return complain("`--coverage` is of the rehearsals, which `--cheats` does not run. Write one of them.",
                        exit_bad_input);
    ExitCode worst = exit_pass;
    UsedPlugins used(with);
    if (!options.seeds.empty()) {
        const std::optional<Seeds> seeds = read_seeds(options.seeds);
        if (!seeds)
            return complain("`--seeds` is out of range: got `" + text::shown(options.seeds) +
                                "`, expected FIRST..LAST, at most " + std::to_string(max_seeds) + " seeds up to " +
                                std::to_string(documents::max_seed) + ". Write `--seeds 1..20`.",
                            exit_bad_input);
        if (!options.anatomy.empty())
            return complain("`--seeds` makes bones, and `--anatomy` names a file. Write one of them.", exit_bad_input);
        if (options.is_with_cheats || options.is_with_coverage)
            return complain("`--seeds` runs one good hand. Write it without `--cheats` and `--coverage`.",
                            exit_bad_input);
        for (const auto& file : options.procedures)
            worst = std::max(worst, seeds_file(file, *seeds, options, with, used));
        used.warn_of_replaced();
        return worst;
    }
    for (const auto& file : options.procedures)
        worst = std::max(worst, options.is_with_cheats ? cheat_file(file, options, with, used)
                                                       : rehearse_file(file, options, with, used));
    used.warn_of_replaced();
    return worst;
}

}  // namespace commands
}  // namespace kerf::app
