// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

namespace {

Command check_row() {
    using T = CheckOptions;
    const auto pattern = [](const std::string& example) {
        return text("PATTERN", "a regular expression, as in " + example);
    };
    return {
        .name = "check",
        .group = "Plugins",
        .summary = "Test plugins for conformance: tables, geometry, laws, real time, physics",
        .arguments = {{.name = "PLUGIN",
                       .value = file("the file of a plugin, as in `build/lib/kerf/kerf_peck.so`", ".so"),
                       .help = "Shared libraries of plugins",
                       .is_required = true,
                       .member = in<T>(&T::plugins)}},
        .options =
            {{.name = "--level",
              .value = {.placeholder = "LEVEL", .kind = ValueKind::number, .min = 1, .max = 5},
              .help = "1 loads and describes, 2 and geometry, 3 and laws (default), 4 and physics, 5 and procedures",
              .default_value = "3",
              .member = in<T>(&T::level)},
             {.name = "--only",
              .value = pattern("`law`"),
              .help = "Only tests whose id matches this regular expression",
              .member = in<T>(&T::only)},
             {.name = "--exclude",
              .value = pattern("`^law\\.time$`"),
              .help = "Leave out tests whose id matches; each with its --reason",
              .member = in<T>(&T::excluded)},
             {.name = "--reason",
              .value = text("TEXT", "a reason"),
              .help = "Why they are left out; the report shows it",
              .member = in<T>(&T::reasons)},
             {.name = "--twin",
              .value = file("the file of a plugin", ".so", "PLUGIN"),
              .help = "At level 5: the same plugin from another compiler, which must give the same bits",
              .member = in<T>(&T::twin)},
             {.name = "--procedure",
              .value = yaml("PROCEDURE"),
              .help = "At level 5: run these",
              .default_value = "the shipped procedures that use the plugin",
              .member = in<T>(&T::procedures)},
             format_of<T>({"text", "json", "junit"}, "text (default), json or junit"),
             out_of<T>(file("a file, as in `--out check.xml`"),
                       "Write the report to this file; text still goes to the terminal"),
             {.name = "--accept",
              .value = file("an acceptance file, as in `--accept peck.csv`", ".csv"),
              .help =
                  "Lead the law along this file's script and compare its forces with those recorded, in place of the "
                  "tests",
              .member = in<T>(&T::accept)},
             {.name = "--record",
              .value = file("a file, as in `--record peck.csv`", ".csv"),
              .help = "Record an acceptance file; one that is there gives the script, else a standard one is taken",
              .member = in<T>(&T::record)},
             {.name = "--law",
              .value = text("LAW", "a tool and a law, as in `--law 'burr with burring'`"),
              .help = "Of --accept and --record: which law, as in 'burr with burring'",
              .member = in<T>(&T::law)},
             {.name = "--differences",
              .value = folder(),
              .help = "Of --accept: folder for the differences as CSV and picture",
              .default_value = "out/check",
              .member = in<T>(&T::differences)}},
        .when_missing = "which plugin? Write `kerf check PLUGIN.so`.",
        .examples = {{"kerf check build/lib/kerf/kerf_peck.so --level 4", "runs the tests up to level 4"}},
        .footer = "Exit code: 0 no test failed, 1 one failed, 2 bad input, 3 fault or interrupted.",
        .defaults = T{},
        .run = own_program("check")};
}

}  // namespace

std::vector<Command> plugin_commands() {
    std::vector<Command> rows;
    rows.push_back({.name = "list",
                    .group = "Plugins",
                    .summary = "List the tools, force laws and remeshing strategies of all plugins",
                    .defaults = ListOptions{},
                    .run = with_environment(&commands::list)});
    rows.push_back({.name = "describe",
                    .group = "Plugins",
                    .summary = "Describe the parameters, drives, signals and events of components",
                    .arguments = {{.name = "COMPONENT",
                                   .value = text("", "the name of a plugin, as `kerf list` shows it"),
                                   .help = "PLUGIN or PLUGIN/COMPONENT",
                                   .default_value = "all",
                                   .member = in<DescribeOptions>(&DescribeOptions::component)}},
                    .examples = {{"kerf describe kerf.drilling", "describes a plugin with units, ranges and sources"}},
                    .defaults = DescribeOptions{},
                    .run = with_environment(&commands::describe)});
    rows.push_back(check_row());
    using T = NewOptions;
    rows.push_back(
        {.name = "new",
         .group = "Plugins",
         .summary = "Write a plugin or a procedure to begin with, into a folder of its own",
         .arguments = {{.name = "KIND",
                        .value = one_of("", {"plugin", "procedure"}),
                        .help = "plugin (a burr that builds and runs), or procedure (with its anatomy, a "
                                "good hand and three bad ones)",
                        .is_required = true,
                        .member = in<T>(&T::kind)},
                       {.name = "NAME",
                        .value = {.placeholder = "", .kind = ValueKind::any},
                        .help = "Its name, as in `round_burr`",
                        .is_required = true,
                        .member = in<T>(&T::name)}},
         .options = {out_of<T>(folder(), "The folder to make", "the name"),
                     flag("--strategy", "A plugin with a remeshing strategy, in place of a tool with its law",
                          in<T>(&T::is_strategy))},
         .when_missing = "what? Write `kerf new plugin NAME` or `kerf new procedure NAME`.",
         .examples = {{"kerf new plugin round_burr", "writes the folder round_burr"},
                      {"kerf new procedure my_hole", "writes my_hole/my_hole.yaml and its anatomy"}},
         .defaults = T{},
         .run = with_environment(&commands::begin_folder)});
    return rows;
}

}  // namespace kerf::app::table
