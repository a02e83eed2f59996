// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

namespace {

constexpr const char* hint_of_run =
    "Writes session.db, summary.json, report.html and bone.stl; bone-1.stl … if it came apart,\n"
    "implant-1.stl … of what stays in it.\n"
    "Exit code: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault or interrupted.\n"
    "A replay: 1 too where nothing could be compared, 3 where it differs or its recording was changed.";

/// A run that is watched loads no plugin itself: each of its runs is a process. A window has a program of its own.
ExitCode run_or_watch(const Options& options, const Invocation& call) {
    const auto& of_run = std::get<RunOptions>(options);
    if (of_run.is_in_window) return become_window(call.here, call.argv);
    return of_run.is_watched ? commands::watch(of_run, call) : with_environment(&commands::run)(options, call);
}

Command run_command_row() {
    using T = RunOptions;
    return {
        .name = "run",
        .group = "Procedures",
        .summary = "Run a procedure, assess it and write the results",
        .arguments = {procedure_of<T>()},
        .options = {anatomy_of<T>(),
                    variant_of<T>(),
                    patches_of<T>(),
                    settings_of<T>(),
                    {.name = "--hand",
                     .value = text("REHEARSAL", "the id of a rehearsal"),
                     .help = "Rehearsal for the simulated hand",
                     .default_value = "the first, or that of the recording",
                     .member = in<T>(&T::hand)},
                    {.name = "--replay",
                     .value = file("the name of a session.db", ".db", "SESSION"),
                     .help = "Repeat the hand of this session.db, to the same bits",
                     .member = in<T>(&T::replay)},
                    {.name = "--continue",
                     .value = file("the name of a session.db", ".db", "SESSION"),
                     .help = "Repeat this session up to `--at`, then continue it by mouse: practice alone",
                     .member = in<T>(&T::parent)},
                    {.name = "--at",
                     .value = text("SECONDS", "a time, as in `--at 20.5`"),
                     .help = "Time of the session of `--continue`",
                     .default_value = "its end",
                     .member = in<T>(&T::at)},
                    out_of<T>(folder(), "Folder for the results", "out/ and the procedure's id",
                              "Replaces an earlier run, nothing else"),
                    {.name = "--learner",
                     .value = {.placeholder = "CODE", .kind = ValueKind::code},
                     .help = "Code of the trainee, never a name",
                     .member = in<T>(&T::learner)},
                    {.name = "--mode",
                     .value = one_of("MODE", {"practice", "exam", "demo"}),
                     .help = "practice (default), exam or demo",
                     .default_value = "practice",
                     .member = in<T>(&T::mode)},
                    {.name = "--assist",
                     .value = one_of("LEVEL", {"off", "on-request", "stepwise", "full"}),
                     .help = "Help with plan, zones, limits and hints: off, on-request, stepwise or full",
                     .default_value = "that of the procedure",
                     .member = in<T>(&T::assist)},
                    language_of<T>(),
                    flag("--live", "Run on the wall clock: one tick each millisecond", in<T>(&T::is_live)),
                    {.name = "--device",
                     .value = text("ID", "a device as `kerf devices` shows it, as in `--device udp`"),
                     .help = "Lead the tool with this device, on the wall clock; `mouse` with --window",
                     .default_value = "the rehearsal's hand",
                     .member = in<T>(&T::device)},
                    flag("--window", "Show the operation in a window, on the wall clock", in<T>(&T::is_in_window)),
                    {.name = "--screenshot",
                     .value = file("the name of a picture, as in `--screenshot end.png`", ".png"),
                     .help = "With --window: write its last picture and close it",
                     .member = in<T>(&T::screenshot)},
                    flag("--headless", "Run without a window, as without `--window`", in<T>(&T::is_headless)),
                    flag("--watch",
                         "Run again whenever a plugin, the procedure, its anatomy or their data change, until Ctrl-C",
                         in<T>(&T::is_watched))},
        .when_missing = "which procedure? Write `kerf run PROCEDURE.yaml`.",
        .examples = {{"kerf run pedicle-screw.yaml", "runs a shipped procedure with its first rehearsal"},
                     {"kerf run pedicle-screw.yaml --replay out/pedicle-screw/session.db --out out/again",
                      "repeats a recorded run"}},
        .footer = hint_of_run,
        .defaults = T{},
        .run = &run_or_watch};
}

Command window_row() {
    using T = WindowOptions;
    const auto folder_of = [](const std::string& example) {
        return Value{
            .placeholder = "FOLDER", .kind = ValueKind::folder, .expects = "a folder, as in `" + example + "`"};
    };
    return {.name = "window",
            .group = "Procedures",
            .summary = "Start operations from a page: choose a procedure, watch earlier attempts",
            .options = {{.name = "--procedures",
                         .value = folder_of("--procedures my-operations"),
                         .help = "Folder of the procedures",
                         .default_value = "the shipped ones",
                         .member = in<T>(&T::procedures)},
                        {.name = "--attempts",
                         .value = folder_of("--attempts attempts"),
                         .help = "Folder for the attempts, each in a folder of its own",
                         .default_value = "attempts",
                         .note = "Replaces nothing",
                         .member = in<T>(&T::attempts)},
                        {.name = "--learner",
                         .value = {.placeholder = "CODE", .kind = ValueKind::code},
                         .help = "Code of the trainee, never a name; the page can change it",
                         .member = in<T>(&T::learner)},
                        language_of<T>()},
            .examples = {{"kerf window", "shows the shipped procedures"},
                         {"kerf window --procedures my-operations --learner L17",
                          "shows the procedures of a folder, and the attempts of a trainee"}},
            .footer = "Exit code: 0 closed, 2 bad input, 3 fault or no display.",
            .defaults = T{},
            .run = [](const Options&, const Invocation& call) { return become_window(call.here, call.argv); }};
}

Command explain_row() {
    return {.name = "explain",
            .group = "Procedures",
            .summary = "Explain a code such as E0412: its meaning, its reason, what to do",
            .arguments = {{.name = "CODE",
                           .value = text("", "a code, as in `E0412`"),
                           .help = "the code before a message",
                           .default_value = "a list of all",
                           .member = in<ExplainOptions>(&ExplainOptions::code)}},
            .examples = {{"kerf explain E0412", "explains the code E0412"}},
            .defaults = ExplainOptions{},
            .run = with_environment(&commands::explain)};
}

Command schema_row() {
    return {.name = "schema",
            .group = "Procedures",
            .summary = "Print the JSON Schema of a kind of document, for editors",
            .arguments = {{.name = "KIND",
                           .value = one_of("", {"procedure", "anatomy", "station"}),
                           .help = "procedure (default), anatomy or station",
                           .default_value = "procedure",
                           .member = in<SchemaOptions>(&SchemaOptions::kind)}},
            .examples = {{"kerf schema anatomy", "prints the schema of anatomies"}},
            .defaults = SchemaOptions{},
            .run = with_environment(&commands::print_schema)};
}

}  // namespace

std::vector<Command> procedure_commands() {
    std::vector<Command> rows;
    rows.push_back(run_command_row());
    rows.push_back(window_row());
    rows.push_back(
        {.name = "validate",
         .group = "Procedures",
         .summary = "Check procedures without running them",
         .arguments = {procedures_of<ValidateOptions>()},
         .options = {anatomy_of<ValidateOptions>("procedures'"),
                     format_of<ValidateOptions>({"text", "json", "github"},
                                                "text (default), json, or github for its annotations"),
                     variant_of<ValidateOptions>(),
                     patches_of<ValidateOptions>(),
                     settings_of<ValidateOptions>(),
                     flag("--bone",
                          "Make the bone too, and check what depends on it: axes, scans, hands, the force scale",
                          in<ValidateOptions>(&ValidateOptions::is_with_bone)),
                     {.name = "--device",
                      .value = text("MODEL", "a modelled device, as in `--device touch`"),
                      .help = "Run a hand on this modelled device, and show what it feels; may be repeated",
                      .member = in<ValidateOptions>(&ValidateOptions::devices)}},
         .when_missing = "which procedure? Write `kerf validate PROCEDURE.yaml`.",
         .examples = {{"kerf validate my-procedure.yaml --bone", "checks a procedure and its bone"},
                      {"kerf validate my-procedure.yaml --device touch", "shows what a hand feels on a Touch"}},
         .footer = "Exit code: 0 no errors, 2 errors.",
         .defaults = ValidateOptions{},
         .run = with_environment(&commands::validate)});
    rows.push_back(
        {.name = "rehearse",
         .group = "Procedures",
         .summary = "Run every rehearsal and compare its result with `expect:`",
         .arguments = {procedures_of<RehearseOptions>()},
         .options = {anatomy_of<RehearseOptions>("procedures'"),
                     variant_of<RehearseOptions>(),
                     patches_of<RehearseOptions>(),
                     settings_of<RehearseOptions>(),
                     flag("--cheats", "Run standing bad hands instead, made of the first hand that passes",
                          in<RehearseOptions>(&RehearseOptions::is_with_cheats)),
                     flag("--coverage", "Also list steps and limits that no rehearsal ends or breaks",
                          in<RehearseOptions>(&RehearseOptions::is_with_coverage)),
                     {.name = "--seeds",
                      .value = text("FIRST..LAST", "two whole numbers, as in `--seeds 1..20`"),
                      .help = "Run the first hand that passes on each of these made bones instead",
                      .member = in<RehearseOptions>(&RehearseOptions::seeds)}},
         .when_missing = "which procedure? Write `kerf rehearse PROCEDURE.yaml`.",
         .examples = {{"kerf rehearse pedicle-screw.yaml", "runs all rehearsals of a shipped procedure"},
                      {"kerf rehearse my.yaml --cheats", "shows whether a bad hand can pass a procedure"},
                      {"kerf rehearse my.yaml --seeds 1..20", "runs the operation on the bones of twenty people"}},
         .footer = "Exit code: 0 all ended as expected, no bad hand passed, or no person failed and one passed; 1 "
                   "otherwise; 2 bad input; 3 fault or interrupted.",
         .defaults = RehearseOptions{},
         .run = with_environment(&commands::rehearse)});
    rows.push_back(
        {.name = "expand",
         .group = "Procedures",
         .summary = "Print the procedure with a variant, `--patch` and `--set` applied, and the origin of each value",
         .arguments = {procedure_of<ExpandOptions>()},
         .options = {variant_of<ExpandOptions>(), patches_of<ExpandOptions>(), settings_of<ExpandOptions>()},
         .when_missing = "which procedure? Write `kerf expand PROCEDURE.yaml`.",
         .examples = {{"kerf expand amputation.yaml --variant transtibial", "prints a variant as one document"}},
         .defaults = ExpandOptions{},
         .run = with_environment(&commands::expand)});
    rows.push_back(
        {.name = "preview",
         .group = "Procedures",
         .summary =
             "Write a page that shows a procedure before it is run: bone, zones, landmarks, the tool at each goal",
         .arguments = {procedure_of<PreviewOptions>()},
         .options = {anatomy_of<PreviewOptions>(), variant_of<PreviewOptions>(), patches_of<PreviewOptions>(),
                     settings_of<PreviewOptions>(),
                     out_of<PreviewOptions>(file("a file, as in `--out preview.html`", ".html"), "An .html file",
                                            "out/ and the procedure's id")},
         .when_missing = "which procedure? Write `kerf preview PROCEDURE.yaml`.",
         .examples = {{"kerf preview pedicle-screw.yaml --out preview.html", "writes the page preview.html"}},
         .defaults = PreviewOptions{},
         .run = with_environment(&commands::preview)});
    rows.push_back(explain_row());
    rows.push_back(schema_row());
    return rows;
}

}  // namespace kerf::app::table
