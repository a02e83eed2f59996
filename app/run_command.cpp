// SPDX-License-Identifier: Apache-2.0
// `kerf run`.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/badges/used_plugins.h"
#include "app/commands.h"
#include "app/interruption.h"
#include "app/language.h"
#include "app/make_bone.h"
#include "app/outputs.h"
#include "app/own_device.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/read_scene.h"
#include "app/replay.h"
#include "app/replay_result.h"
#include "app/seconds.h"
#include "app/shown_in_window.h"
#include "app/shown_run.h"
#include "app/standard_streams.h"
#include "app/watch.h"
#include "core/haptics/loop/stated_device.h"
#include "run/exact/exact_strategies.h"
#include "run/live_run.h"
#include "run/run_checks.h"
#include "run/run_procedure.h"
#include "session/content_hash.h"
#include "session/output_folder.h"
#include "session/read_session.h"
#include "session/recorder.h"

namespace kerf::app {

namespace {

std::string text_of(const session::ExactRow& exact) {
    constexpr std::string_view none = "no exact surface";
    if (!exact.why_not.empty())
        return "  " + (exact.why_not.starts_with(none) ? "" : std::string(none) + ": ") + exact.why_not + "\n";
    std::size_t triangles = 0;
    for (const session::ExactRow::Piece& piece : exact.pieces) triangles += piece.triangles;
    std::string text =
        formatted("  exact surface: %zu %s, %zu triangles, digest %s\n", exact.pieces.size(),
                  exact.pieces.size() == 1 ? "body" : "bodies", triangles, session::hex16(exact.digest).c_str());
    for (const std::string& note : exact.notes) text += "    " + note + "\n";
    return text;
}

std::string text_of(const session::ClockRow& clock) {
    std::string text = formatted(
        "  clock: %llu ticks, %llu late, %llu pauses; compute median %.0f us, 99.9 %% within %.0f us, worst %.2f ms\n",
        static_cast<unsigned long long>(clock.ticks), static_cast<unsigned long long>(clock.late_ticks),
        static_cast<unsigned long long>(clock.pauses), 1e6 * clock.compute.median, 1e6 * clock.compute.p999,
        1e3 * clock.compute.worst);
    std::string causes;
    for (const auto& [cause, ticks] : clock.late_causes)
        if (ticks > 0) causes += (causes.empty() ? "" : ", ") + std::to_string(ticks) + " " + cause;
    if (!causes.empty()) text += "    late: " + causes + "\n";
    for (const std::string& refusal : clock.refusals) text += "    " + refusal + "\n";
    return text;
}

bool is_measure(const session::MetricRow& m) {
    return m.id.starts_with("measure.") || m.id.find(".measure.") != std::string::npos;
}

/// Returns " ± 1.1" for the uncertainty of a measure, with two significant digits.
std::string text_of_uncertainty(const session::MetricRow& m) {
    const double uncertainty = m.uncertainty / m.per_unit;
    if (!is_measure(m) || !(uncertainty >= 5e-7)) return "";
    return formatted(uncertainty < 9.95 ? " ± %#.2g" : " ± %.0f", uncertainty);
}

/// Two decimals, or two significant digits.
std::string text_of(const session::MetricRow& m) {
    double value = m.value / m.per_unit;
    if (std::abs(value) < 5e-7) value = 0.0;
    const bool is_small = value != 0.0 && std::abs(value) < 0.1;
    return formatted(is_small ? "  %-34s %8.2g" : "  %-34s %8.2f", m.id.c_str(), value) + text_of_uncertainty(m) +
           (m.unit.empty() ? "" : " " + m.unit) + (m.status.starts_with("grade") ? "  " + m.status : "") + "\n";
}

void print_summary(const session::RunSummary& s) {
    print(std::string("verdict: ") + to_text(s.verdict) + "\n");
    print(formatted("score: %.0f of 100\n", std::round(s.score)));
    for (const auto& reason : s.reasons) print("  " + reason + "\n");
    // A measure without a limit of its step is only in summary.json.
    const auto is_shown = [](const session::MetricRow& m) {
        return m.status != "info" || m.id.find(".measure.") == std::string::npos;
    };
    const auto print_metrics = [&](bool of_simulation) {
        for (const auto& m : s.metrics)
            if (session::is_of_simulation(m) == of_simulation && is_shown(m)) print(text_of(m));
    };
    print_metrics(false);
    print(formatted("  removed %.1f mm3, %.1f s simulated, force scale 1/%.0f, hash %016llx\n", s.removed * 1e9,
                    s.duration, 1.0 / s.force_scale, static_cast<unsigned long long>(s.hash)));
    if (s.exact) print(text_of(*s.exact));
    print("checks of the simulation:\n");
    print_metrics(true);
}

/// Returns whether a mouse leads the tool.
bool is_by_mouse(const RunOptions& options) { return options.device == "mouse"; }

/// Returns why the options are refused before any file is read; empty if they are not.
std::string refusal_at_once(const RunOptions& options, const Environment& with) {
    return options.is_in_window && with.display == nullptr ? "this program has no window. Write `kerf run … --window`."
                                                           : refusal_of_language(options.language);
}

/// Returns why options do not fit together, or to the procedure; empty if they do.
std::string refusal_of(const RunOptions& options, const documents::Procedure& procedure) {
    if (options.is_in_window && !options.replay.empty())
        return "a replay has no clock, and a window needs one. Leave out `--window` or `--replay`.";
    if (options.is_in_window && options.is_headless)
        return "`--headless` runs without a window. Leave out one of both.";
    if (!options.screenshot.empty() && !options.is_in_window)
        return "`--screenshot` is a picture of the window. Add `--window`.";
    if (options.is_live && !options.replay.empty()) return "a replay has no clock. Leave out `--live` or `--replay`.";
    if (!options.assist.empty() && options.mode == "exam")
        return "an examination has no help. Leave out `--assist` or `--mode exam`.";
    if (!options.assist.empty() && !options.replay.empty())
        return "a replay has the help of its recording. Leave out `--assist` or `--replay`.";
    if (!options.at.empty() && options.parent.empty())
        return "`--at` is a time of the session of `--continue`. Add `--continue`.";
    if (!options.parent.empty() && !is_by_mouse(options))
        return "a mouse continues a session. Add `--window --device mouse`.";
    if (!options.parent.empty() && options.mode != "practice")
        return "only practice continues a session. Leave out `--continue` or `--mode`.";
    if (options.device.empty()) return {};
    if (is_by_mouse(options) && !options.is_in_window) return "the mouse leads the tool in the window. Add `--window`.";
    if (!options.replay.empty()) return "a replay repeats the recorded hand. Leave out `--device` or `--replay`.";
    if (procedure.is_direct)
        return options.procedure +
               ": `coupling: direct` has no limit for the stiffness that a device feels. Leave out `--device`, or the "
               "coupling.";
    return {};
}

/// The device of a run other than the one that its procedure names.
struct DeviceOfRun {
    OwnDevice own;                           ///< that leads the tool
    std::unique_ptr<StatedDevice> recorded;  ///< of a replayed session

    /// Returns null if there is none, or if it makes no force: then the one of the procedure counts.
    [[nodiscard]] const DeviceRecord* record() const noexcept {
        return own.opened != nullptr ? own.opened->record() : recorded != nullptr ? &recorded->record() : nullptr;
    }
};

/// Opens the device of `--device`, or makes that of a recorded session. Prints why it cannot.
ExitCode choose_device(const RunOptions& options, const std::optional<session::RecordedInputs>& recorded,
                       const Environment& with, const Interruption& interruption, DeviceOfRun& chosen) {
    if (recorded)
        if (const std::string why_not = recorded_device(*recorded, options.replay, chosen.recorded); !why_not.empty())
            return complain(why_not, exit_bad_input);
    return options.device.empty() || is_by_mouse(options)
               ? exit_pass
               : open_leading_device(options.device, with.plugins, interruption, chosen.own);
}

/// Reads the session of `--replay`, if there is one. Returns why it cannot be repeated, for people; empty if it can.
std::string read_recording(const RunOptions& options, const documents::Procedure& procedure,
                           std::optional<session::RecordedInputs>& recorded) {
    if (options.replay.empty()) return {};
    std::string error;
    recorded = session::read_session(options.replay, error);
    if (!recorded) return error;
    if (error = refusal_of_replay(*recorded, options.replay, procedure); !error.empty()) return error;
    if (!options.hand.empty() && options.hand != recorded->rehearsal)
        return options.replay + ": was recorded with the rehearsal `" + recorded->rehearsal + "`, and `--hand` is `" +
               options.hand + "`. Leave out `--hand`.";
    return {};
}

/// Reads the session of `--continue`, if there is one, up to `--at`. Returns why it cannot be continued, for people;
/// empty if it can.
std::string read_parent(const RunOptions& options, const documents::Procedure& procedure,
                        std::shared_ptr<run::RunBeginning>& beginning, std::uint64_t& anatomy_hash) {
    if (options.parent.empty()) return {};
    std::string error;
    const auto recorded = session::read_session(options.parent, error);
    if (!recorded) return error;
    if (error = refusal_of_changed(*recorded, options.parent); !error.empty()) return error;
    if (error = refusal_of_replay(*recorded, options.parent, procedure); !error.empty()) return error;
    if (recorded->uuid.empty())
        return options.parent + ": has no uuid, so it cannot be continued. The file was changed.";
    if (recorded->is_examination) return options.parent + ": was an examination, which cannot be continued.";
    if (!recorded->device_values.empty())
        return options.parent + ": was recorded with the device `" + recorded->device +
               "`. A mouse continues sessions of a mouse or of a rehearsal.";
    beginning = std::make_shared<run::RunBeginning>();
    if (error = repeat(*recorded, options.parent, beginning->run); !error.empty()) return error;
    beginning->parent = recorded->uuid;
    const double duration = 1e-3 * static_cast<double>(recorded->device_from_handle.size());
    const auto at = options.at.empty() ? std::optional(duration) : seconds_of(options.at);
    if (!at || *at <= 0.0 || *at > duration)
        return "`--at` is `" + options.at + "`, and the recording ends after " + formatted("%.3f", duration) +
               " s. Write seconds from 0.001 to " + formatted("%.3f", duration) + ", as in `--at 0.5`.";
    beginning->ticks = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(1e3 * *at)));
    anatomy_hash = recorded->anatomy_hash;
    return {};
}

/// Recorded runs that a run needs.
struct Earlier {
    std::optional<session::RecordedInputs> recorded{};  ///< that `--replay` repeats
    std::shared_ptr<run::RunBeginning> beginning{};     ///< of `--continue`
    std::uint64_t anatomy_of_parent = 0;                ///< hash, of `--continue`

    /// Returns the rehearsal of the run; empty: the first one of the procedure.
    [[nodiscard]] std::string rehearsal(const RunOptions& options) const {
        if (recorded) return recorded->rehearsal;
        return beginning != nullptr && options.hand.empty() ? beginning->run.rehearsal : options.hand;
    }
    /// Returns why a bone does not fit them, for people; empty if it does.
    [[nodiscard]] std::string refusal_of(const run::Scene& scene, const RunOptions& options) const {
        if (recorded && recorded->anatomy_hash != scene.anatomy_hash) return refusal_of_other_text(options.replay);
        if (beginning != nullptr && anatomy_of_parent != scene.anatomy_hash)
            return refusal_of_other_text(options.parent);
        return {};
    }
};

/// Reads the sessions of `--replay` and `--continue`, if there are any. Returns why one cannot be used, for people;
/// empty if both can.
std::string read_earlier(const RunOptions& options, const documents::Procedure& procedure, Earlier& earlier) {
    if (const std::string refusal = read_recording(options, procedure, earlier.recorded); !refusal.empty())
        return refusal;
    return read_parent(options, procedure, earlier.beginning, earlier.anatomy_of_parent);
}

/// Returns why the results may not be written to a folder, for people; empty if they may.
std::string refusal_to_overwrite(const RunOptions& options, const std::string& out) {
    std::error_code ignored;
    const std::string session = out + "/session.db";
    if (!options.replay.empty() && std::filesystem::equivalent(options.replay, session, ignored))
        return "the replay would overwrite its recording. Give another folder with `--out`.";
    if (!options.parent.empty() && std::filesystem::equivalent(options.parent, session, ignored))
        return "the run would overwrite the session that it continues. Give another folder with `--out`.";
    return {};
}

/// Starts the strategies of a procedure. Prints what the run lacks, and continues.
void start(run::ExactStrategies& strategies, const documents::Procedure& procedure) {
    if (const std::string error = strategies.start(procedure); !error.empty()) {
        text::Diagnostics missing;
        run::report_strategy(procedure, strategies.instrument_without(), error, missing);
        print_error(to_text(missing));
    }
    for (const std::string& note : strategies.notes()) print_error("kerf: " + note + "\n");
}

/// Opens the window, if the run has one. Returns why it cannot; empty on success.
std::string open_window(const RunOptions& options, const documents::Procedure& procedure, const Environment& with) {
    if (!options.is_in_window) return {};
    return with.display->open(procedure.translations.of(procedure.title, language_for(options.language)));
}

/// Returns the request of the options alone.
run::RunRequest requested_by(const RunOptions& options, const std::string& rehearsal) {
    run::RunRequest request;
    request.learner = options.learner;
    request.mode = options.mode;
    request.assist = documents::assist_of(options.assist);
    request.rehearsal = rehearsal;
    return request;
}

/// Returns a path that stays the same where a plugin changes the working folder.
std::string absolute_path(const std::string& path) {
    std::error_code no_folder;
    std::string whole = std::filesystem::absolute(path, no_folder).string();
    return no_folder ? path : whole;
}

/// Returns why the results cannot be written there; empty if they can. Called before the bone is made, which may take
/// minutes.
std::string refusal_of_output(const std::string& folder) {
    const std::string refusal = refusal_of_folder(folder);
    return refusal.empty() ? session::refusal_of_output(folder) : refusal;
}

/// Fits the motion of a device that leads the run into its workspace, and lets the run print its problems.
void prepare_device(const run::Scene& scene, const std::string& rehearsal, OwnDevice& device,
                    std::optional<DeviceProblems>& problems, run::RunRequest& request) {
    fit_to_workspace(scene, rehearsal, device);
    request.observers.push_back(&problems.emplace(*device.opened));
}

/// Prints the result of a run. Returns how the program ends, without a comparison of a replay.
ExitCode print_outcome(const run::RunOutcome& outcome, const std::string& folder, const UsedPlugins& used) {
    used.warn_of_replaced();
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    print_summary(outcome.summary);
    print(used.lines());
    if (outcome.summary.clock) print(text_of(*outcome.summary.clock));
    for (const std::string& message : outcome.over_budget) print_error("kerf: " + message + "\n");
    print("  " + folder + "/report.html\n");
    if (outcome.was_interrupted) return complain("interrupted; the results up to now are written", exit_fault);
    return outcome.summary.verdict == session::Verdict::pass ? exit_pass : exit_not_passed;
}

}  // namespace

namespace commands {

ExitCode run(const RunOptions& options, const Environment& with) {
    if (const std::string refusal = refusal_at_once(options, with); !refusal.empty())
        return complain(refusal, exit_bad_input);
    const std::string& file = options.procedure;
    text::Diagnostics diagnostics;
    auto documents = run::check_documents(request_of(file, options, with.here), with.plugins).take(diagnostics);
    if (!documents) {
        with_findings(std::nullopt, diagnostics);
        return exit_bad_input;
    }
    if (const std::string refusal = refusal_of(options, documents->procedure); !refusal.empty())
        return complain(refusal, exit_bad_input);
    const std::string out = options.out.empty() ? "out/" + documents->procedure.id : options.out;
    if (const std::string refusal = refusal_of_output(out); !refusal.empty()) return complain(refusal, exit_bad_input);
    Earlier earlier;
    if (const std::string refusal = read_earlier(options, documents->procedure, earlier); !refusal.empty())
        return complain(refusal, exit_bad_input);
    const std::optional<session::RecordedInputs>& recorded = earlier.recorded;
    const std::string rehearsal = earlier.rehearsal(options);
    if (const std::string refusal = run::refusal_of_rehearsal(documents->procedure, rehearsal); !refusal.empty())
        return complain(refusal, exit_bad_input);
    UsedPlugins used(with);
    used.add(documents->procedure, is_by_mouse(options) ? "" : options.device);
    // Started while this process has one thread and little memory.
    run::ExactStrategies strategies(with.here.strategies(with.plugins));
    start(strategies, documents->procedure);
    if (const std::string note = note_of_language(options.language, documents->procedure.translations); !note.empty())
        print_error("kerf: " + note + "\n");
    const Interruption interruption;  // a second Ctrl-C ends the program at once
    DeviceOfRun of_run;
    if (const std::string why_not = open_window(options, documents->procedure, with); !why_not.empty())
        return complain(why_not, exit_fault);
    const auto choose = [&] { return choose_device(options, recorded, with, interruption, of_run); };
    const bool waits_for_device = options.is_in_window && !options.device.empty();
    if (const ExitCode code =
            waits_for_device ? wait_shown("Waiting for the device", *with.display, interruption, choose) : choose();
        code != exit_pass)
        return code;
    if (of_run.record() != nullptr) documents->device = of_run.record();
    auto made = options.is_in_window ? make_bone_shown(std::move(*documents), file, *with.display).take(diagnostics)
                                     : make_bone(std::move(*documents), file).take(diagnostics);
    const auto scene = with_findings(std::move(made), diagnostics);
    if (!scene) return exit_bad_input;
    if (interruption.has_come() || (options.is_in_window && with.display->wants_end()))
        return complain("ended before anything was cut; nothing is written", exit_fault);
    if (const std::string refusal = earlier.refusal_of(*scene, options); !refusal.empty())
        return complain(refusal, exit_bad_input);
    run::RunRequest request = requested_by(options, rehearsal);
    request.beginning = earlier.beginning;
    ShownRun shown_run(interruption);
    request.observers = {&shown_run};
    request.strategies = &strategies;
    if (recorded)
        if (const std::string error = repeat(*recorded, options.replay, request); !error.empty())
            return complain(error, exit_bad_input);
    request.out = absolute_path(out);
    request.parts = used.parts();
    if (const std::string refusal = refusal_to_overwrite(options, out); !refusal.empty())
        return complain(refusal, exit_bad_input);
    std::optional<DeviceProblems> problems;
    if (of_run.own.opened != nullptr) prepare_device(*scene, rehearsal, of_run.own, problems, request);
    run::MouseBox mouse;
    const auto run = [&](const run::RunRequest& requested) {
        if (is_by_mouse(options)) return run::run_live(*scene, with.plugins, requested, mouse);
        if (of_run.own.opened != nullptr)
            return run::run_live(*scene, with.plugins, requested, *of_run.own.opened, of_run.own.station);
        return options.is_live || options.is_in_window ? run::run_live(*scene, with.plugins, requested)
                                                       : run::run_procedure(*scene, with.plugins, requested);
    };
    const run::RunOutcome outcome =
        options.is_in_window ? run_shown(*scene, request, language_for(options.language),
                                         is_by_mouse(options) ? &mouse : nullptr, interruption, *with.display, run)
                             : run(request);
    shown_run.end_work();
    const ExitCode code = print_outcome(outcome, out, used);
    if (!recorded || !outcome.error.empty() || outcome.was_interrupted) return code;
    const std::string session = out + "/session.db";
    return std::max(code,
                    compare({*recorded, options.replay, outcome.summary, session, scene->procedure, with.plugins}));
}

ExitCode watch(const RunOptions& options, const Invocation& call) {
    std::vector<std::string> arguments;
    for (int i = 1; i < call.argc; ++i)
        if (std::string(call.argv[i]) != "--watch") arguments.emplace_back(call.argv[i]);
    return run_and_watch(options, call.here.program(), std::move(arguments), plugin_folders_of(call.here));
}

}  // namespace commands
}  // namespace kerf::app
