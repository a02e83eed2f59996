// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/anatomy_text.h"
#include "app/badges/plugin_verdict.h"
#include "app/completion.h"
#include "app/cue_table.h"
#include "app/describe.h"
#include "app/findings.h"
#include "app/import_source.h"
#include "app/make_anatomy.h"
#include "app/make_bone.h"
#include "app/man_page.h"
#include "app/new_folder.h"
#include "app/outputs.h"
#include "app/preview/preview_page.h"
#include "app/privacy/privacy_report.h"
#include "app/progress.h"
#include "app/read_scene.h"
#include "app/remesh_session.h"
#include "app/standard_streams.h"
#include "documents/patch.h"
#include "documents/read_procedure.h"
#include "documents/schema.h"
#include "documents/shapes/shapes.h"
#include "run/lone_anatomy.h"
#include "run/run_checks.h"
#include "session/recorder.h"
#include "session/report/read_run.h"
#include "session/report/report.h"
#include "text/codes.h"
#include "text/file_kind.h"
#include "text/printable_lines.h"
#include "text/shell.h"
#include "text/write_file.h"

namespace kerf::app::commands {

namespace {

/// Returns a function that reads the badge of a plugin, and prints why one is ignored.
BadgeWords badge_words(const Environment& with) {
    return [&with, store = BadgeStore::of_environment()](const std::string& plugin) {
        const std::string file = file_of_plugin(with.plugins, plugin);
        if (file.empty()) return std::string();
        const PluginVerdict verdict = verdict_on(plugin, file, with.here, store);
        if (!verdict.fault.empty()) print_error("kerf: " + verdict.fault + "\n");
        return store.is_off() && !verdict.is_shipped ? std::string() : verdict.words();
    };
}

}  // namespace

ExitCode validate(const ValidateOptions& options, const Environment& with) {
    std::vector<Findings> all;
    for (const auto& file : options.procedures) {
        Findings& one = all.emplace_back(Findings{file, {}});
        const auto documents =
            run::check_documents(request_of(file, options, with.here), with.plugins).take(one.diagnostics);
        if (options.variant.empty()) {
            const text::Diagnostics of_variants =
                run::check_variants(request_of(file, options, with.here), one.diagnostics, with.plugins);
            one.diagnostics.insert(one.diagnostics.end(), of_variants.begin(), of_variants.end());
        }
        if (documents && options.is_with_bone) print_notes(make_bone(*documents, file).take(one.diagnostics));
        if (!documents || text::has_error(one.diagnostics)) continue;
        for (const std::string& device : options.devices)
            if (const ExitCode code = print_cues(*documents, file, device, with); code != exit_pass) return code;
    }
    print(findings_text(all, options.format));
    return std::any_of(all.begin(), all.end(), [](const Findings& f) { return text::has_error(f.diagnostics); })
               ? exit_bad_input
               : exit_pass;
}

ExitCode expand(const ExpandOptions& options, const Environment& with) {
    text::Diagnostics diagnostics;
    const auto procedure =
        documents::read_procedure(options.procedure, with.plugins.catalog(), options.changes()).take(diagnostics);
    print_error(to_text(diagnostics));
    if (!procedure) return exit_bad_input;
    print(std::string("# ") + session::notice_line + "\n" + documents::emitted(*procedure->document, true));
    return exit_pass;
}

ExitCode describe(const DescribeOptions& options, const Environment& with) {
    std::string error;
    std::error_code ignored;
    if (const std::string text = description_of_bone(options.component, error); !text.empty()) {
        print(text);
        return exit_pass;
    }
    if (!error.empty()) return complain(error, exit_bad_input);
    const auto text = description_of(with.plugins, options.component, error, badge_words(with));
    if (!text && std::filesystem::is_regular_file(options.component, ignored))
        if (const text::RecognisedFile file = text::recognise(options.component); !file.name.empty())
            error = "`" + options.component + "` is a file: " +
                    text::other_kind_text(file, "a plugin or a component, as in `kerf describe kerf.drilling`");
    if (!text) return complain(error, exit_bad_input);
    print(*text);
    return exit_pass;
}

ExitCode explain(const ExplainOptions& options, const Environment& /*with*/) {
    if (options.code.empty()) {
        print(text::list_of_codes());
        return exit_pass;
    }
    const text::CodeEntry* entry = text::find_code(options.code);
    if (entry == nullptr)
        return complain("there is no code `" + options.code + "`. Write `kerf explain` to see all.", exit_bad_input);
    print(text::explanation_of(*entry));
    return exit_pass;
}

ExitCode print_schema(const SchemaOptions& options, const Environment& with) {
    const documents::Shape& shape = options.kind == "anatomy"   ? documents::shapes::anatomy
                                    : options.kind == "station" ? documents::shapes::station
                                                                : documents::shapes::procedure;
    print(text::printable_json(documents::schema_text(shape, with.plugins.catalog(), session::notice_line)));
    return exit_pass;
}

// ---- bones ----------------------------------------------------------------------------------------------------

ExitCode import(const ImportSourceOptions& options, const Environment& /*with*/) {
    const ImportOutcome outcome = import_source({.source = options.source,
                                                 .out = options.out,
                                                 .series = options.series,
                                                 .acquisition = options.acquisition,
                                                 .may_resample = options.may_resample,
                                                 .unit = options.unit,
                                                 .frame = options.frame});
    print(outcome.text);
    print_error(to_text(outcome.diagnostics));
    if (text::has_error(outcome.diagnostics)) return exit_bad_input;
    if (!outcome.error.empty()) return complain(outcome.error, exit_bad_input);
    print(std::string(session::notice_line) + ".\n");
    return exit_pass;
}

namespace {

ExitCode check_anatomy(const AnatomyOptions& options, const Environment& with) {
    const bool has_options_of_make = !options.level.empty() || !options.sex.empty() || !options.height.empty() ||
                                     !options.age.empty() || !options.seed.empty() || options.is_osteoporotic ||
                                     !options.settings.empty() || !options.out.empty();
    if (has_options_of_make)
        return complain("`kerf anatomy check` takes `--for` and `--format` alone. The other options belong to `make`.",
                        exit_bad_input);
    text::Diagnostics diagnostics;
    if (options.procedure.empty()) {
        const auto alone = run::make_lone_anatomy(options.anatomy, {.with_shifts = true}).take(diagnostics);
        if (alone) print(anatomy_text(*alone));
    } else {
        DocumentOptions documents;
        documents.anatomy = options.anatomy;
        const auto scene = make_scene(options.procedure, documents, with, {.with_shifts = true}).take(diagnostics);
        if (scene) print(anatomy_text(scene->anatomy, scene->body, scene->import));
    }
    std::vector<Findings> findings{{options.anatomy, diagnostics}};
    print(findings_text(findings, options.format));
    return text::has_error(diagnostics) ? exit_bad_input : exit_pass;
}

ExitCode make_anatomy(const AnatomyOptions& options) {
    if (!options.procedure.empty())
        return complain("`--for` belongs to `kerf anatomy check`. Remove it.", exit_bad_input);
    const text::Result<documents::MadeBone> bone = make_bone_of(options);
    if (!bone) {
        print_error(to_text(bone.diagnostics()));
        return exit_bad_input;
    }
    if (options.out.empty()) {
        print(bone->text);
        return exit_pass;
    }
    if (const std::string error = text::write_file(options.out, bone->text); !error.empty())
        return complain(error, exit_bad_input);
    print(made_bone_text(*bone) + options.out + "\n");
    return exit_pass;
}

}  // namespace

ExitCode anatomy(const AnatomyOptions& options, const Environment& with) {
    return options.action == "make" ? make_anatomy(options) : check_anatomy(options, with);
}

ExitCode preview(const PreviewOptions& options, const Environment& with) {
    if (const std::string refusal = options.out.empty() ? "" : refusal_of_page(options.out); !refusal.empty())
        return complain(refusal, exit_bad_input);
    text::Diagnostics diagnostics;
    const auto scene =
        make_scene(options.procedure, options, with, {.with_shifts = true, .with_scan = true}).take(diagnostics);
    print_error(to_text(diagnostics));
    if (!scene) return exit_bad_input;
    const std::string file = options.out.empty() ? "out/" + scene->procedure.id + "-preview.html" : options.out;
    const StillWorking sign_of_life("drawing");
    if (const std::string error = write_page(file, preview_page(*scene)); !error.empty())
        return complain(error, exit_bad_input);
    print(file + "\n");
    return exit_pass;
}

// ---- sessions --------------------------------------------------------------------------------------------------

ExitCode report(const ReportOptions& options, const Environment& /*with*/) {
    namespace fs = std::filesystem;
    const std::string file =
        options.out.empty() ? (fs::path(options.session).parent_path() / "report.html").string() : options.out;
    // Never the session itself, nor another record.
    if (const std::string refusal = options.out.empty() ? "" : refusal_of_page(file); !refusal.empty())
        return complain(refusal, exit_bad_input);
    std::error_code ignored;
    if (fs::equivalent(options.session, file, ignored))
        return complain("the page would overwrite its session. Give another file with `--out`.", exit_bad_input);

    std::string error;
    const auto run = session::read_run(options.session, error);
    if (!run) return complain(error, exit_bad_input);
    if (error = write_page(file, session::report_html(run->summary, run->drawn, run->procedure)); !error.empty())
        return complain(error + (options.out.empty() ? " Give another file with `--out`." : ""), exit_bad_input);
    if (!run->missing.empty()) print_error(run->missing + "\n");
    print(file + "\n");
    return exit_pass;
}

ExitCode print_privacy(const PrivacyOptions& options, const Environment& /*with*/) {
    ExitCode worst = exit_pass;
    for (const std::string& file : options.files) {
        const PrivacyReport report = privacy_report(file);
        if (!report.error.empty()) {
            worst = complain(report.error, exit_bad_input);
            continue;
        }
        print(privacy_text(file, report, options.shows_values));
        const ExitCode of_file = report.is_partial          ? exit_bad_input
                                 : !report.findings.empty() ? exit_not_passed
                                                            : exit_pass;
        worst = std::max(worst, of_file);
    }
    return worst;
}

ExitCode begin_folder(const NewOptions& options, const Environment& /*with*/) {
    const bool is_procedure = options.kind == "procedure";
    if (is_procedure && options.is_strategy)
        return complain("`--strategy` is for a plugin. Write `kerf new plugin " + options.name + " --strategy`.",
                        exit_bad_input);
    const NewKind kind = is_procedure ? NewKind::procedure : options.is_strategy ? NewKind::strategy : NewKind::tool;
    if (const std::string error = write_new_folder(kind, options.name, options.out); !error.empty())
        return complain(error, exit_bad_input);
    const std::string folder = options.out.empty() ? options.name : options.out;
    const auto within = [&](const std::string& path) { return text::shell_path(folder + "/" + path); };
    if (is_procedure) {
        const std::string file = within(options.name + ".yaml");
        print(folder + "\nCheck it:    kerf validate " + file + " --bone\nRehearse it: kerf rehearse " + file +
              " --coverage\nCheat it:    kerf rehearse " + file + " --cheats\nRun it:      kerf run " + file + "\n");
        return exit_pass;
    }
    const std::string build = within("build");
    print(folder + "\nBuild it: cmake -S " + text::shell_path(folder) + " -B " + build +
          " -D CMAKE_PREFIX_PATH=WHERE_KERF_IS && cmake --build " + build + "\nTest it:  ctest --test-dir " + build +
          "\nCheck it: kerf check " + within("build/lib/kerf/kerf_" + options.name + ".so") + " --level 4\n");
    return exit_pass;
}

ExitCode list(const ListOptions& /*options*/, const Environment& with) {
    print(list_of_components(with.plugins, badge_words(with)));
    return exit_pass;
}

ExitCode remesh(const RemeshOptions& options, const Environment& with) { return remesh_session(options, with); }

ExitCode print_completion(const CompletionOptions& options) {
    print(completion_script(options.shell));
    return exit_pass;
}

ExitCode print_man_page(const ManOptions& /*options*/) {
    print(man_page());
    return exit_pass;
}

}  // namespace kerf::app::commands
