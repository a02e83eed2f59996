// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

namespace {

Value session(const std::string& placeholder = "") { return file("the name of a session.db", ".db", placeholder); }

/// The session of a command, as an argument.
template <class T>
Parameter session_of() {
    return {.name = "SESSION",
            .value = session(),
            .help = "session.db of a run",
            .is_required = true,
            .member = in<T>(&T::session)};
}

/// The options that name the documents of a session, and then others.
template <class T>
std::vector<Parameter> with_documents(std::vector<Parameter> others) {
    std::vector<Parameter> all{{.name = "--procedure",
                                .value = yaml("PROCEDURE"),
                                .help = "Its procedure",
                                .default_value = "the shipped one with its text",
                                .member = in<T>(&T::procedure)},
                               {.name = "--anatomy",
                                .value = yaml(),
                                .help = "The anatomy it was run with, if not the procedure's own",
                                .member = in<T>(&T::anatomy)},
                               patches_of<T>("The `--patch` it was run with; may be repeated"),
                               settings_of<T>("The `--set` it was run with; may be repeated")};
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

Command view_row() {
    using T = ViewOptions;
    return {.name = "view",
            .group = "Sessions",
            .summary = "Watch a recorded operation in a window, or draw pictures of it",
            .arguments = {session_of<T>()},
            .options = with_documents<T>(
                {{.name = "--at",
                  .value = text("SECONDS", "a time, as in `--at 20.5`"),
                  .help = "Time to begin at",
                  .default_value = "the start; of a picture, the end",
                  .member = in<T>(&T::at)},
                 {.name = "--screenshot",
                  .value = file("the name of a picture, as in `--screenshot at-20-s.png`", ".png"),
                  .help = "Write a picture of this time and end; needs no display",
                  .member = in<T>(&T::screenshot)},
                 {.name = "--frames",
                  .value = {.placeholder = "FOLDER",
                            .kind = ValueKind::folder,
                            .expects = "a folder, as in `--frames out/film`"},
                  .help = "Write a picture for every 40 ms and end; needs no display",
                  .member = in<T>(&T::frames)},
                 flag("--inspect", "Show the law at the tip: its points, forces, channels, bone and coupling",
                      in<T>(&T::is_inspecting)),
                 flag("--recorded", "Show the session alone: tool, plots and result over the bone of the end",
                      in<T>(&T::is_recorded)),
                 language_of<T>()}),
            .when_missing = "which run? Write `kerf view SESSION.db`.",
            .examples = {{"kerf view out/pedicle-screw/session.db", "shows the operation again, with a time line"},
                         {"kerf view out/pedicle-screw/session.db --at 20 --screenshot at-20-s.png",
                          "writes a picture of the operation after 20 s"}},
            .footer =
                "Without a procedure, anatomy and plugins that fit, the session alone is shown, with a sentence why. "
                "Exit code: 0 shown, 2 bad input, 3 fault, no display or interrupted.",
            .defaults = T{},
            .run = [](const Options&, const Invocation& call) { return become_window(call.here, call.argv); }};
}

Command remesh_row() {
    using T = RemeshOptions;
    return {.name = "remesh",
            .group = "Sessions",
            .summary = "Make the exact surface of what a session left: bone-exact.stl, remesh.json",
            .arguments = {session_of<T>()},
            .options = with_documents<T>({{.name = "--strategy",
                                           .value = text("STRATEGY", "a strategy, as `example.burring.groove`"),
                                           .help = "Strategy for all tools, by a name that `kerf list` shows",
                                           .default_value = "what the procedure names, or else what suits the tool",
                                           .member = in<T>(&T::strategy)},
                                          out_of<T>(folder(), "Folder for the results", "that of the session")}),
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
    rows.push_back(view_row());
    rows.push_back(remesh_row());
    rows.push_back({.name = "privacy",
                    .group = "Sessions",
                    .summary = "List personal data in files: names, numbers, dates, paths",
                    .arguments = {{.name = "FILE",
                                   .value = file("the name of a file"),
                                   .help = "DICOM, images or files of Kerf, one or more",
                                   .is_required = true,
                                   .member = in<PrivacyOptions>(&PrivacyOptions::files)}},
                    .options = {flag("--show", "Print the values, not only their first letters",
                                     in<PrivacyOptions>(&PrivacyOptions::shows_values))},
                    .when_missing = "which file? Write `kerf privacy FILE`.",
                    .examples = {{"kerf privacy out/pedicle-screw/session.db", "checks a session before you share it"}},
                    .footer = "Exit code: 0 nothing found, 1 something found, 2 a file cannot be read to its end. The "
                              "list may be incomplete.",
                    .defaults = PrivacyOptions{},
                    .run = with_environment(&commands::print_privacy)});
    return rows;
}

}  // namespace kerf::app::table
