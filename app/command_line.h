// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// What the user asked for: `kerf COMMAND …`.
namespace kerf {

/// Exit codes; scripts depend on them.
enum ExitCode : int {
    exit_pass = 0,
    exit_not_passed = 1,  ///< fail, incomplete or invalid; a rehearsal that ended otherwise than it says
    exit_bad_input = 2,
    exit_fault = 3,  ///< of the machine or the program, or interrupted
};

struct CommandLine {
    std::string command;  ///< "run", "validate", "rehearse", "describe", "schema", "explain", "expand", "list", "plan",
                          ///< "privacy", "report", "remesh", "stability", "chart", "check"; empty: `answer` is all
    std::vector<std::string> files;  ///< procedures, of privacy any; at least one for run, validate, rehearse, plan and
                                     ///< expand, exactly one for run, plan and expand
    std::string component;           ///< of describe: "PLUGIN", "PLUGIN/COMPONENT", or empty for all
    std::string code;                ///< of explain; empty: all
    std::string kind = "procedure";  ///< of schema: procedure | anatomy
    std::string anatomy;             ///< file; empty: the procedure's own
    std::string shipped;             ///< folder of the shipped procedures, which the program sets
    std::string variant;             ///< id; empty: the procedure as it stands
    std::vector<std::string> settings;  ///< "path=value" each
    bool is_with_bone = false;          ///< of validate
    std::string hand, replay, learner;
    std::string out;  ///< folder; empty: out/ and the procedure's id, out/stability or out/chart; of plan: none; of
                      ///< report: beside the session
    std::string plugin = "kerf.drilling";  ///< of stability: whose first tool and force are looked at
    bool is_quick = false;                 ///< of stability and chart
    std::string scene;                     ///< of chart: the only one; empty: all
    std::string source;               ///< of import: a scan, a folder or a surface; of report and remesh: a session
    std::string series, acquisition;  ///< of import
    bool may_resample = false;        ///< of import
    bool shows_values = false;        ///< of privacy
    bool has_strategy = false;        ///< of new plugin
    std::string strategy;             ///< of remesh; empty: what procedure or tool names
    std::string unit = "mm", frame;   ///< of import: a surface's; frame empty: as the file says, or LPS
    std::string action;               ///< of anatomy: "check"
    std::string mode = "practice";    ///< practice | exam | demo
    bool is_headless = false;         ///< so is every run for now
    bool is_watched = false;          ///< of run
    std::string format = "text";      ///< of validate: text | json | github; of check: text | json | junit

    std::string only;                              ///< of check: a pattern on the tests' ids; empty: all
    std::vector<std::string> excluded, reasons;    ///< of check: patterns, and why each is left out
    int level = 3;                                 ///< of check: 1 … 5
    std::string twin;                              ///< of check: the same plugin, built otherwise
    std::vector<std::string> procedures;           ///< of check, at level 5
    std::string accept, record, law, differences;  ///< of check: acceptance files

    std::string answer;         ///< to print instead of doing anything: help, version, or what is wrong
    int exit_code = exit_pass;  ///< with `answer`; exit_bad_input belongs on stderr
};

/// Reads the arguments. Never throws, prints or exits.   [main]
[[nodiscard]] CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace kerf
