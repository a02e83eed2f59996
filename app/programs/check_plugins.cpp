// SPDX-License-Identifier: Apache-2.0
#include "app/programs/check_plugins.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <vector>

#include "app/interruption.h"
#include "app/programs/keep_badge.h"
#include "app/progress.h"
#include "app/standard_streams.h"
#include "conformance/acceptance.h"
#include "conformance/check.h"
#include "conformance/report.h"
#include "session/recorder.h"
#include "text/file_kind.h"
#include "text/regular_file.h"
#include "text/write_file.h"

namespace kerf::app {

namespace {

using namespace conformance;
namespace fs = std::filesystem;

std::string refusal_of(const CheckOptions& options) {
    if (options.excluded.size() != options.reasons.size())
        return "`--exclude` is given " + std::to_string(options.excluded.size()) + " time(s) and `--reason` " +
               std::to_string(options.reasons.size()) +
               ". Write a reason for each, as in `--exclude law.time --reason 'a slow machine'`.";
    std::vector<std::string> patterns = options.excluded;
    patterns.push_back(options.only);
    for (const std::string& pattern : patterns)
        if (const std::string refusal = refusal_of_pattern(pattern); !refusal.empty()) return refusal;
    std::error_code ignored;
    for (const std::string& file : options.plugins)
        if (fs::is_directory(file, ignored))
            return "`" + file + "` is a folder. Write the file of a plugin, as in `" + file + "/*.so`.";
    std::vector<std::string> files = options.plugins;
    files.insert(files.end(), options.procedures.begin(), options.procedures.end());
    if (!options.twin.empty()) files.push_back(options.twin);
    for (const std::string& file : files) {
        const auto fault = text::fault_of_file(file);
        if (!fault || fs::is_directory(file, ignored)) continue;
        return !fs::exists(fs::symlink_status(file, ignored))
                   ? "`" + file + "` does not exist. Check its name and its folder."
                   : "`" + file + "` cannot be read: " + fault->problem + " " + fault->advice;
    }
    for (const std::string& file : options.plugins)
        if (const text::RecognisedFile found = text::recognise(file);
            !found.name.empty() && found.kind != text::FileKind::shared_library)
            return "`" + file + "` is of another kind: " +
                   text::other_kind_text(found,
                                         "a plugin, which is a shared library such as `build/lib/kerf/kerf_peck.so`") +
                   (found.kind == text::FileKind::procedure ? "" : " `kerf validate` checks procedures.");
    if (options.level < 5 && (!options.procedures.empty() || !options.twin.empty()))
        return "`--procedure` and `--twin` belong to level 5. Add `--level 5`.";
    return {};
}

/// `--accept` and `--record`, in place of the tests.
ExitCode accept_or_record(const CheckOptions& options, const std::string& child) {
    if (!options.accept.empty() && !options.record.empty())
        return complain("`--accept` and `--record` are both given. Write one of them.", exit_bad_input);
    if (options.plugins.size() > 1)
        return complain("an acceptance file belongs to one plugin. Name one.", exit_bad_input);
    const bool is_record = options.accept.empty();
    const AcceptanceRequest request{.child = child,
                                    .plugin = options.plugins.front(),
                                    .file = is_record ? options.record : options.accept,
                                    .law = options.law,
                                    .folder = options.differences.empty() ? "out/check" : options.differences};
    const AcceptanceOutcome outcome = is_record ? record(request) : accept(request);
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    print(std::string(session::notice_line) + ".\n" + outcome.text);
    return outcome.is_accepted ? exit_pass : exit_not_passed;
}

}  // namespace

ExitCode check_plugins(const CheckOptions& options, const Installation& here) {
    if (const std::string refusal = refusal_of(options); !refusal.empty()) return complain(refusal, exit_bad_input);
    const std::string child = here.helper("kerf-check-child");
    if (!options.accept.empty() || !options.record.empty()) return accept_or_record(options, child);
    const Interruption interruption;
    CheckRequest request{.child = child,
                         .level = options.level,
                         .only = options.only,
                         .is_interrupted = [&] { return interruption.has_come(); },
                         .program = here.program(),
                         .procedures = options.procedures,
                         .shipped = here.procedures(),
                         .twin = options.twin};
    for (std::size_t i = 0; i < options.excluded.size(); ++i)
        request.excluded.emplace_back(options.excluded[i], options.reasons[i]);

    const bool is_text = options.format == "text", shows_text = is_text || !options.out.empty();
    std::vector<PluginReport> reports;
    std::string text;
    const auto show = [&](const std::string& more) {
        text += more;
        if (shows_text) print(more);
    };
    show(std::string(session::notice_line) + ".\n");
    const BadgeStore badges = BadgeStore::of_environment();
    for (const std::string& file : options.plugins) {
        const BadgeKeeper badge(badges, file);
        reports.push_back(check_plugin(file, request, [&](const TestResult& result) {
            show_work(result.id);
            if (const std::string one = text_of(result, file); !one.empty()) show(one);
        }));
        show_work("");
        if (!reports.back().error.empty()) return complain(file + ": " + reports.back().error, exit_fault);
        if (reports.back().results.empty())
            return complain("no test matches `--only " + options.only + "` up to level " +
                                std::to_string(options.level) + ". `kerf check --help` explains the levels.",
                            exit_bad_input);
        show(summary_of(reports.back()));
        if (options.only.empty()) badge.keep(reports.back(), options.level);
    }
    const std::string report = options.format == "json"    ? json_text(reports)
                               : options.format == "junit" ? junit_text(reports)
                                                           : text;
    if (options.out.empty()) {
        if (!is_text) print(report);
    } else if (const std::string error = text::write_file(options.out, report); !error.empty()) {
        return complain(error, exit_fault);
    }
    return std::all_of(reports.begin(), reports.end(), is_conforming) ? exit_pass : exit_not_passed;
}

}  // namespace kerf::app
