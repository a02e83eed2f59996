// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "app/anatomy_text.h"
#include "app/describe.h"
#include "app/findings.h"
#include "app/import_source.h"
#include "app/interruption.h"
#include "app/make_bone.h"
#include "app/new_plugin.h"
#include "app/outputs.h"
#include "app/preview/preview_page.h"
#include "app/privacy.h"
#include "app/progress.h"
#include "app/read_scene.h"
#include "app/remesh_session.h"
#include "app/replay.h"
#include "app/standard_streams.h"
#include "documents/patch.h"
#include "documents/schema.h"
#include "documents/shapes.h"
#include "run/exact/exact_strategies.h"
#include "run/run_checks.h"
#include "run/run_procedure.h"
#include "session/content_hash.h"
#include "session/read_session.h"
#include "session/record_checksum.h"
#include "session/recorder.h"
#include "session/report/read_run.h"
#include "session/report/report.h"
#include "text/codes.h"
#include "text/printable_lines.h"
#include "text/write_file.h"

namespace kerf {

namespace {

std::string text_of(const ExactRow& exact) {
    constexpr std::string_view none = "no exact surface";
    if (!exact.why_not.empty())
        return "  " + (exact.why_not.starts_with(none) ? "" : std::string(none) + ": ") + exact.why_not + "\n";
    std::size_t triangles = 0;
    for (const ExactRow::Piece& piece : exact.pieces) triangles += piece.triangles;
    std::string text = formatted("  exact surface: %zu %s, %zu triangles, digest %s\n", exact.pieces.size(),
                                 exact.pieces.size() == 1 ? "body" : "bodies", triangles, hex16(exact.digest).c_str());
    for (const std::string& note : exact.notes) text += "    " + note + "\n";
    return text;
}

/// Two digits behind the point, or two that count.
std::string text_of(const MetricRow& m) {
    double value = m.value / m.per_unit;
    if (std::abs(value) < 5e-7) value = 0.0;
    const bool is_small = value != 0.0 && std::abs(value) < 0.1;
    return formatted(is_small ? "  %-34s %8.2g" : "  %-34s %8.2f", m.id.c_str(), value) +
           (m.unit.empty() ? "" : " " + m.unit) + (m.status.starts_with("grade") ? "  " + m.status : "") + "\n";
}

void print_summary(const RunSummary& s) {
    print(std::string("verdict: ") + to_text(s.verdict) + "\n");
    for (const auto& reason : s.reasons) print("  " + reason + "\n");
    // A measure that no limit of its step is on stands in summary.json; here, before and after.
    const auto is_shown = [](const MetricRow& m) {
        return m.status != "info" || m.id.find(".measure.") == std::string::npos;
    };
    const auto print_metrics = [&](bool of_simulation) {
        for (const auto& m : s.metrics)
            if (is_of_simulation(m) == of_simulation && is_shown(m)) print(text_of(m));
    };
    print_metrics(false);
    print(formatted("  removed %.1f mm3, %.1f s simulated, force scale 1/%.0f, hash %016llx\n", s.removed * 1e9,
                    s.duration, 1.0 / s.force_scale, static_cast<unsigned long long>(s.hash)));
    if (s.exact) print(text_of(*s.exact));
    print("checks of the simulation:\n");
    print_metrics(true);
}

// ---- validate ----------------------------------------------------------------------------------------------------

ExitCode validate(const CommandLine& line, const PluginRegistry& plugins) {
    std::vector<Findings> all;
    for (const auto& file : line.files) {
        Findings& one = all.emplace_back(Findings{file, {}});
        const auto documents = check_documents(request_of(file, line), plugins, one.diagnostics);
        if (line.variant.empty()) {
            const Diagnostics of_variants = check_variants(request_of(file, line), one.diagnostics, plugins);
            one.diagnostics.insert(one.diagnostics.end(), of_variants.begin(), of_variants.end());
        }
        if (documents && line.is_with_bone) print_notes(make_bone(*documents, file, one.diagnostics));
    }
    print(findings_text(all, line.format));
    return std::any_of(all.begin(), all.end(), [](const Findings& f) { return has_error(f.diagnostics); })
               ? exit_bad_input
               : exit_pass;
}

/// Shows the progress of a run, and ends it at the first Ctrl-C.
class ShownRun final : public RunObserver {
public:
    explicit ShownRun(const Interruption& interruption) : interruption_(interruption) {}
    void on_progress(double fraction, const std::string& what) override { show_progress(fraction, what); }
    std::optional<RunEnd> end() override {
        return interruption_.has_come() ? std::optional(RunEnd::interrupted) : std::nullopt;
    }

private:
    const Interruption& interruption_;
};

// ---- rehearse ----------------------------------------------------------------------------------------------------

std::string expectation_of(const Rehearsal& rehearsal) {
    if (rehearsal.expect != "fail") return rehearsal.expect;
    return "fail by the limit `" + rehearsal.expect_limit +
           (rehearsal.expects_others ? "`, and others may break" : "` alone") +
           (rehearsal.expect_step.empty() ? "" : ", in the step `" + rehearsal.expect_step + "`");
}

std::string ending_of(const RunSummary& summary) {
    std::string text = to_text(summary.verdict);
    for (const auto& reason : summary.reasons) text += "\n            " + shown(reason);
    return text;
}

ExitCode rehearse(const std::string& file, const CommandLine& line, const PluginRegistry& plugins) {
    const auto scene = read_scene(file, line, plugins);
    if (!scene) return exit_bad_input;
    if (scene->procedure.rehearsals.empty())
        return complain(file + " has no rehearsals. Add one under `rehearsals:`.", exit_bad_input);

    int as_expected = 0;
    for (const auto& rehearsal : scene->procedure.rehearsals) {
        RunRequest request;
        request.rehearsal = rehearsal.id;
        const Interruption interruption;
        ShownRun shown_run(interruption);
        request.observers = {&shown_run};
        const RunOutcome outcome = run_procedure(*scene, plugins, request);
        if (outcome.was_interrupted) return complain("interrupted", exit_fault);
        if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
        print(rehearsal.id + ": " + (outcome.is_as_expected ? "ended as expected" : "NOT AS EXPECTED") +
              "\n  expected  " + expectation_of(rehearsal) + "\n  ended     " + ending_of(outcome.summary) + "\n");
        as_expected += outcome.is_as_expected;
    }
    const int count = static_cast<int>(scene->procedure.rehearsals.size());
    print(file + formatted(": %d of %d rehearsals ended as expected\n", as_expected, count));
    return as_expected == count ? exit_pass : exit_not_passed;
}

// ---- run ---------------------------------------------------------------------------------------------------------

/// Says whether a replay ended as its recording did, and whether the recording is as it was written.
ExitCode compare(const RecordedInputs& recorded, const RunSummary& replayed) {
    ExitCode code = exit_pass;
    const auto say = [&](const char* what, ExitCode comes_to) {
        print(std::string("  replay: ") + what + "\n");
        code = std::max(code, comes_to);
    };
    if (recorded.hash.empty())
        say("nothing to compare with: the recording ends without a result", exit_not_passed);
    else if (recorded.hash == hex16(replayed.hash))
        say("the same bits", exit_pass);
    else
        say("NOT the same bits", exit_fault);
    if (recorded.rows == RecordCheck::changed)
        say("the recording was CHANGED after its run wrote it: its rows do not give its checksum", exit_fault);
    if (recorded.rows == RecordCheck::unknown && recorded.is_old)
        say("the rows of the recording were not checked: this old session has no checksum", exit_pass);
    else if (recorded.rows == RecordCheck::unknown && !recorded.hash.empty())
        say("the rows of the recording were not checked: it is incomplete", exit_not_passed);
    return code;
}

ExitCode run(const CommandLine& line, const PluginRegistry& plugins, const Installation& here) {
    if (const std::string refusal = line.out.empty() ? "" : refusal_of_folder(line.out); !refusal.empty())
        return complain(refusal, exit_bad_input);
    const std::string& file = line.files.front();
    Diagnostics diagnostics;
    auto documents = check_documents(request_of(file, line), plugins, diagnostics);
    if (!documents) {
        with_findings(std::nullopt, diagnostics);
        return exit_bad_input;
    }

    // Before the bone is made, which may take minutes: can it be run at all?
    std::string rehearsal = line.hand;
    std::optional<RecordedInputs> recorded;
    if (!line.replay.empty()) {
        std::string error;
        recorded = read_session(line.replay, error);
        if (recorded) error = refusal_of_replay(*recorded, line.replay, documents->procedure);
        if (recorded && error.empty() && !line.hand.empty() && line.hand != recorded->rehearsal)
            error = line.replay + ": was recorded with the rehearsal `" + recorded->rehearsal + "`, and `--hand` is `" +
                    line.hand + "`. Leave out `--hand`.";
        if (!error.empty()) return complain(error, exit_bad_input);
        rehearsal = recorded->rehearsal;
    }
    if (const std::string refusal = refusal_of_rehearsal(documents->procedure, rehearsal); !refusal.empty())
        return complain(refusal, exit_bad_input);
    ExactStrategies strategies(here.strategies(plugins));  // while this process has one thread and little memory
    if (const std::string error = strategies.start(documents->procedure); !error.empty()) {
        Diagnostics missing;  // apart from the others: the run does without it
        report_strategy(documents->procedure, strategies.instrument_without(), error, missing);
        print_error(to_text(missing));
    }
    for (const std::string& note : strategies.notes()) print_error("kerf: " + note + "\n");
    const Interruption interruption;  // a second one ends the program at once
    auto made = make_bone(std::move(*documents), file, diagnostics);
    const auto scene = with_findings(std::move(made), diagnostics);
    if (!scene) return exit_bad_input;
    if (interruption.has_come()) return complain("interrupted before anything was cut; nothing is written", exit_fault);
    if (recorded && recorded->anatomy_hash != scene->anatomy_hash)
        return complain(refusal_of_other_text(line.replay), exit_bad_input);

    RunRequest request;
    ShownRun shown_run(interruption);
    request.observers = {&shown_run};
    request.strategies = &strategies;
    request.learner = line.learner;
    request.mode = line.mode;
    request.rehearsal = rehearsal;
    if (recorded)
        if (const std::string error = repeat(*recorded, line.replay, request); !error.empty())
            return complain(error, exit_bad_input);
    request.out = line.out.empty() ? "out/" + scene->procedure.id : line.out;
    std::error_code ignored;
    if (!line.replay.empty() && std::filesystem::equivalent(line.replay, request.out + "/session.db", ignored))
        return complain("the replay would overwrite its recording. Give another folder with `--out`.", exit_bad_input);

    const RunOutcome outcome = run_procedure(*scene, plugins, request);
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    print_summary(outcome.summary);
    for (const std::string& line_of_law : outcome.over_budget) print_error("kerf: " + line_of_law + "\n");
    print("  " + request.out + "/report.html\n");
    if (outcome.was_interrupted) return complain("interrupted; the results up to now are written", exit_fault);
    const ExitCode judged = outcome.summary.verdict == Verdict::pass ? exit_pass : exit_not_passed;
    return recorded ? std::max(judged, compare(*recorded, outcome.summary)) : judged;
}

// ---- report ------------------------------------------------------------------------------------------------------

ExitCode report(const CommandLine& line) {
    namespace fs = std::filesystem;
    const std::string file =
        line.out.empty() ? (fs::path(line.source).parent_path() / "report.html").string() : line.out;
    // Never the session itself, nor another record.
    if (const std::string refusal = line.out.empty() ? "" : refusal_of_page(file); !refusal.empty())
        return complain(refusal, exit_bad_input);
    std::error_code ignored;
    if (fs::equivalent(line.source, file, ignored))
        return complain("the page would overwrite its session. Give another file with `--out`.", exit_bad_input);

    std::string error;
    const auto run = read_run(line.source, error);
    if (!run) return complain(error, exit_bad_input);
    if (error = write_page(file, report_html(run->summary, run->drawn, run->procedure)); !error.empty())
        return complain(error + (line.out.empty() ? " Give another place with `--out`." : ""), exit_bad_input);
    if (!run->missing.empty()) print_error(run->missing + "\n");
    print(file + "\n");
    return exit_pass;
}

ExitCode expand(const CommandLine& line, const PluginRegistry& plugins) {
    Diagnostics diagnostics;
    const auto procedure =
        read_procedure(line.files.front(), plugins.catalog(), diagnostics, {line.variant, line.settings});
    print_error(to_text(diagnostics));
    if (!procedure) return exit_bad_input;
    print(std::string("# ") + notice_line + "\n" + emitted(*procedure->document, true));
    return exit_pass;
}

ExitCode describe(const CommandLine& line, const PluginRegistry& plugins) {
    std::string error;
    const auto text = description_of(plugins, line.component, error);
    if (!text) return complain(error, exit_bad_input);
    print(*text);
    return exit_pass;
}

ExitCode explain(const CommandLine& line) {
    if (line.code.empty()) {
        print(list_of_codes());
        return exit_pass;
    }
    const CodeEntry* entry = find_code(line.code);
    if (entry == nullptr)
        return complain("there is no code `" + line.code + "`. Write `kerf explain` to see all.", exit_bad_input);
    print(explanation_of(*entry));
    return exit_pass;
}

ExitCode print_schema(const CommandLine& line, const PluginRegistry& plugins) {
    const Shape& shape = line.kind == "anatomy" ? shapes::anatomy : shapes::procedure;
    print(printable_json(schema_text(shape, plugins.catalog(), notice_line)));
    return exit_pass;
}

// ---- what is given ------------------------------------------------------------------------------------------------

ExitCode import(const CommandLine& line) {
    const ImportOutcome outcome = import_source({.source = line.source,
                                                 .out = line.out,
                                                 .series = line.series,
                                                 .acquisition = line.acquisition,
                                                 .may_resample = line.may_resample,
                                                 .unit = line.unit,
                                                 .frame = line.frame});
    print(outcome.text);
    print_error(to_text(outcome.diagnostics));
    if (has_error(outcome.diagnostics)) return exit_bad_input;
    if (!outcome.error.empty()) return complain(outcome.error, exit_bad_input);
    print(std::string(notice_line) + ".\n");
    return exit_pass;
}

ExitCode check_anatomy(const CommandLine& line, const PluginRegistry& plugins) {
    Diagnostics diagnostics;
    const auto scene = make_scene(line.files.front(), line, plugins, diagnostics, {.with_shifts = true});
    if (scene) print(anatomy_text(*scene));
    std::vector<Findings> findings{{line.anatomy, diagnostics}};
    print(findings_text(findings, line.format));
    return has_error(diagnostics) ? exit_bad_input : exit_pass;
}

ExitCode preview(const CommandLine& line, const PluginRegistry& plugins) {
    if (const std::string refusal = line.out.empty() ? "" : refusal_of_page(line.out); !refusal.empty())
        return complain(refusal, exit_bad_input);
    Diagnostics diagnostics;
    const auto scene =
        make_scene(line.files.front(), line, plugins, diagnostics, {.with_shifts = true, .with_scan = true});
    print_error(to_text(diagnostics));
    if (!scene) return exit_bad_input;
    const std::string file = line.out.empty() ? "out/" + scene->procedure.id + "-preview.html" : line.out;
    const StillWorking sign_of_life("drawing");
    if (const std::string error = write_page(file, preview_page(*scene)); !error.empty())
        return complain(error, exit_bad_input);
    print(file + "\n");
    return exit_pass;
}

ExitCode tell_privacy(const CommandLine& line) {
    ExitCode worst = exit_pass;
    for (const std::string& file : line.files) {
        const PrivacyReport report = privacy_report(file);
        if (!report.error.empty()) {
            worst = complain(report.error, exit_bad_input);
            continue;
        }
        print(privacy_text(file, report, line.shows_values));
        if (!report.findings.empty()) worst = std::max(worst, exit_not_passed);
    }
    return worst;
}

ExitCode begin_plugin(const CommandLine& line) {
    if (const std::string error = write_new_plugin(line.source, line.out, line.has_strategy); !error.empty())
        return complain(error, exit_bad_input);
    const std::string folder = line.out.empty() ? line.source : line.out;
    print(folder + "\nBuild it: cmake -S " + folder + " -B " + folder +
          "/build -D CMAKE_PREFIX_PATH=WHERE_KERF_IS && cmake --build " + folder +
          "/build\nTest it:  ctest --test-dir " + folder + "/build\nCheck it: kerf check " + folder +
          "/build/lib/kerf/kerf_" + line.source + ".so --level 4\n");
    return exit_pass;
}

}  // namespace

ExitCode run_command(const CommandLine& line, const PluginRegistry& plugins, const Installation& here) {
    if (line.command == "run") return run(line, plugins, here);
    if (line.command == "validate") return validate(line, plugins);
    if (line.command == "expand") return expand(line, plugins);
    if (line.command == "explain") return explain(line);
    if (line.command == "schema") return print_schema(line, plugins);
    if (line.command == "import") return import(line);
    if (line.command == "preview") return preview(line, plugins);
    if (line.command == "report") return report(line);
    if (line.command == "remesh") return remesh_session(line, plugins, here.strategies(plugins));
    if (line.command == "privacy") return tell_privacy(line);
    if (line.command == "anatomy") return check_anatomy(line, plugins);
    if (line.command == "describe") return describe(line, plugins);
    if (line.command == "new") return begin_plugin(line);
    if (line.command == "rehearse") {
        ExitCode worst = exit_pass;
        for (const auto& file : line.files) worst = std::max(worst, rehearse(file, line, plugins));
        return worst;
    }
    print(list_of_components(plugins));
    return exit_pass;
}

}  // namespace kerf
