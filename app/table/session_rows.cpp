// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

namespace {

Value session(const std::string& placeholder = "") { return file("the name of a session.db", ".db", placeholder); }

Command remesh_row() {
    using T = RemeshOptions;
    return {.name = "remesh",
            .group = "Sessions",
            .summary = "Make the exact surface of what a session left: bone-exact.stl, remesh.json",
            .arguments = {{.name = "SESSION",
                           .value = session(),
                           .help = "session.db of a run",
                           .is_required = true,
                           .member = in<T>(&T::session)}},
            .options = {{.name = "--procedure",
                         .value = yaml("PROCEDURE"),
                         .help = "Its procedure",
                         .default_value = "the shipped one with its text",
                         .member = in<T>(&T::procedure)},
                        {.name = "--anatomy",
                         .value = yaml(),
                         .help = "The anatomy it was run with, if not the procedure's own",
                         .member = in<T>(&T::anatomy)},
                        patches_of<T>("The `--patch` it was run with; may be repeated"),
                        settings_of<T>("The `--set` it was run with; may be repeated"),
                        {.name = "--strategy",
                         .value = text("STRATEGY", "a strategy, as `example.burring.groove`"),
                         .help = "Strategy for all tools, by a name that `kerf list` shows",
                         .default_value = "what the procedure names, or else what suits the tool",
                         .member = in<T>(&T::strategy)},
                        out_of<T>(folder(), "Folder for the results", "that of the session")},
            .when_missing = "of which run? Write `kerf remesh SESSION.db`.",
            .examples = {{"kerf remesh out/pedicle-screw/session.db", "writes bone-exact.stl next to the session"}},
            .footer = "Exit code: 0 made, 2 bad input, 3 no exact surface could be made.",
            .defaults = T{},
            .run = with_environment(&commands::remesh)};
}

}  // namespace

std::vector<Command> session_commands() {
    std::vector<Command> rows;
    rows.push_back({.name = "report",
                    .group = "Sessions",
                    .summary = "Write report.html again from a session.db",
                    .arguments = {{.name = "SESSION",
                                   .value = session(),
                                   .help = "session.db of a run, complete or not",
                                   .is_required = true,
                                   .member = in<ReportOptions>(&ReportOptions::session)}},
                    .options = {out_of<ReportOptions>(file("a file, as in `--out report.html`", ".html"),
                                                      "An .html file", "report.html in the session's folder")},
                    .when_missing = "of which run? Write `kerf report SESSION.db`.",
                    .examples = {{"kerf report out/pedicle-screw/session.db", "writes the report again"}},
                    .defaults = ReportOptions{},
                    .run = with_environment(&commands::report)});
    rows.push_back(remesh_row());
    rows.push_back({.name = "privacy",
                    .group = "Sessions",
                    .summary = "List personal data in files: names, numbers, dates, paths",
                    .arguments = {{.name = "FILE",
                                   .value = file("the name of a file"),
                                   .help = "DICOM, an image, or a file of Kerf",
                                   .is_required = true,
                                   .member = in<PrivacyOptions>(&PrivacyOptions::files)}},
                    .options = {flag("--show", "Print the values, not only their first letters",
                                     in<PrivacyOptions>(&PrivacyOptions::shows_values))},
                    .when_missing = "which file? Write `kerf privacy FILE`.",
                    .examples = {{"kerf privacy out/pedicle-screw/session.db", "checks a session before you share it"}},
                    .footer = "Exit code: 0 nothing found, 1 something found, 2 a file cannot be read. The list may be "
                              "incomplete.",
                    .defaults = PrivacyOptions{},
                    .run = with_environment(&commands::print_privacy)});
    return rows;
}

}  // namespace kerf::app::table
