// SPDX-License-Identifier: Apache-2.0
#include "app/replay_result.h"

#include <algorithm>
#include <cstddef>

#include "app/badges/plugin_verdict.h"
#include "app/standard_streams.h"
#include "session/content_hash.h"
#include "session/first_difference.h"
#include "session/record_checksum.h"
#include "session/recorded_versions.h"
#include "text/shell.h"

namespace kerf::app {

namespace {

void report(const std::string& what) { print("  replay: " + what + "\n"); }

/// Prints each part whose version, or whose file, is not the recorded one. Badges have no effect on the bits.
void report_other_versions(const EndedReplay& replay) {
    const auto before = session::recorded_versions(replay.recorded_file),
               now = session::recorded_versions(replay.replayed_file);
    for (const auto& [part, version] : before)
        if (const auto found = now.find(part);
            found != now.end() && found->second != version && !part.ends_with(" badge") && !part.ends_with(" file"))
            report("it was recorded with other code: " + part + " was " + version + ", and is " + found->second);
}

/// Prints the law of a step, and how to test it. `step` −1: no step ran.
void report_law(const EndedReplay& replay, int step) {
    const auto& steps = replay.procedure.steps;
    if (step < 0 || static_cast<std::size_t>(step) >= steps.size()) return;
    const std::string& id = steps[static_cast<std::size_t>(step)].instrument;
    for (const documents::Instrument& instrument : replay.procedure.instruments) {
        if (instrument.id != id) continue;
        const std::string file = file_of_plugin(replay.plugins, instrument.force_plugin);
        report("the law in hand there is `" + instrument.force + "` of `" + instrument.force_plugin + "`" +
               (file.empty() ? "."
                             : " (" + file + "). Run `kerf check " + text::shell_path(file) +
                                   "`, which tests whether a law depends on anything other than its inputs."));
    }
}

void report_first_difference(const EndedReplay& replay) {
    std::string error;
    const auto first = session::first_difference(replay.recorded_file, replay.replayed_file, error);
    if (!error.empty()) return report("the first difference is not known: " + error);
    if (!first)
        return report(
            "no recorded value differs. They are rounded: the difference is below 32-bit numbers, or in the bone at "
            "the end.");
    report(formatted("the first difference is in tick %llu (%.3f s): ", static_cast<unsigned long long>(first->tick),
                     first->time) +
           first->what);
    if (replay.recorded.rows != session::RecordCheck::changed) report_law(replay, first->step);
}

}  // namespace

ExitCode compare(const EndedReplay& replay) {
    const session::RecordedInputs& recorded = replay.recorded;
    ExitCode code = exit_pass;
    const auto report_result = [&](const char* what, ExitCode result) {
        report(what);
        code = std::max(code, result);
    };
    if (recorded.hash.empty()) {
        report_result("nothing to compare with: the recording ends without a result", exit_not_passed);
    } else if (recorded.hash == session::hex16(replay.replayed.hash)) {
        report_result("the same bits", exit_pass);
    } else {
        report_result("NOT the same bits", exit_fault);
        report_other_versions(replay);
        report_first_difference(replay);
    }
    if (recorded.rows == session::RecordCheck::changed)
        report_result("the recording was CHANGED after its run wrote it: its rows do not give its checksum",
                      exit_fault);
    if (recorded.rows == session::RecordCheck::unknown && recorded.is_old)
        report_result("the rows of the recording were not checked: this old session has no checksum", exit_pass);
    else if (recorded.rows == session::RecordCheck::unknown && !recorded.hash.empty())
        report_result("the rows of the recording were not checked: it is incomplete", exit_not_passed);
    return code;
}

}  // namespace kerf::app
