// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "documents/read_procedure.h"

/// The arguments and options of each command, one struct a command. app/command_table.cpp fills them.
namespace kerf::app {

/// Changes to a procedure.
struct ChangeOptions {
    std::string variant;                ///< id; empty: the procedure without a variant
    std::vector<std::string> patches;   ///< files of changes
    std::vector<std::string> settings;  ///< "path=value" each

    documents::ProcedureChanges changes() const { return {variant, settings, patches}; }
};

/// Changes to a procedure, and its anatomy.
struct DocumentOptions : ChangeOptions {
    std::string anatomy;  ///< file; empty: the anatomy that the procedure names
};

struct RunOptions : DocumentOptions {
    std::string procedure;          ///< file
    std::string hand;               ///< id of a rehearsal; empty: the first
    std::string replay;             ///< file of a session; empty: none
    std::string parent;             ///< file of a session that the mouse continues; empty: none
    std::string at;                 ///< [s] of the parent from which on; empty: its end
    std::string learner;            ///< a code, never a name
    std::string out;                ///< folder; empty: out/ and the procedure's id
    std::string mode = "practice";  ///< practice | exam | demo
    std::string assist;             ///< off | on-request | stepwise | full; empty: that of the procedure
    std::string language;           ///< of the procedure's words; empty: that of the environment
    bool is_headless = false;       ///< accepted for scripts: a run has a window only with `--window`
    bool is_in_window = false;
    std::string screenshot;  ///< file of the window's last picture; empty: the window stays open
    bool is_watched = false;
    bool is_live = false;  ///< on the wall clock
    std::string device;    ///< that leads the tool, as `kerf devices` shows it; empty: the rehearsal's hand
};

struct ValidateOptions : DocumentOptions {
    std::vector<std::string> procedures;
    std::string format = "text";  ///< text | json | github
    bool is_with_bone = false;
    std::vector<std::string> devices;  ///< models whose cues are shown
};

struct RehearseOptions : DocumentOptions {
    std::vector<std::string> procedures;
    bool is_with_cheats = false;    ///< bad hands instead of the rehearsals
    bool is_with_coverage = false;  ///< also what no rehearsal triggers
    std::string seeds;              ///< "1..20": the first hand on as many bones; empty: the procedure's own bone
};

struct ExpandOptions : ChangeOptions {
    std::string procedure;
};

struct PreviewOptions : DocumentOptions {
    std::string procedure;
    std::string out;  ///< page; empty: out/ and the procedure's id
};

struct PlanOptions : DocumentOptions {
    std::string procedure;
    std::string out;  ///< folder; empty: nothing is written
};

struct ExplainOptions {
    std::string code;  ///< empty: all
};

struct SchemaOptions {
    std::string kind = "procedure";  ///< procedure | anatomy | station
};

struct ImportSourceOptions {
    std::string source;               ///< a scan, a folder with DICOM, or a surface
    std::string out;                  ///< file; empty: nothing is written
    std::string series, acquisition;  ///< empty: the only one
    bool may_resample = false;
    std::string unit = "mm";  ///< of a surface: mm | cm | m | um
    std::string frame;        ///< of a surface: LPS | RAS; empty: the frame that the file names, or else LPS
};

struct AnatomyOptions {
    std::string action;   ///< check | make
    std::string anatomy;  ///< of check: a file; of make: a kind of bone
    // of check:
    std::string procedure;
    std::string format = "text";  ///< text | json | github
    // of make; empty: not given
    std::string level, sex, height, age, seed;
    bool is_osteoporotic = false;
    std::vector<std::string> settings;  ///< "dimension=value" each
    std::string out;                    ///< file; empty: the anatomy goes to stdout
};

struct LandmarksOptions {
    std::string anatomy;              ///< file
    std::vector<std::string> points;  ///< "name=ray" each
    std::vector<std::string> axes;    ///< "name=ray; ray" each
    bool is_written = false;          ///< into the file
    std::string spacing;              ///< of the bone; empty: one that it needs
    std::string screenshot;           ///< file of a picture, drawn without a window; empty: none
    std::string side = "oblique";     ///< from which the picture shows the bone
};

struct ReportOptions {
    std::string session;
    std::string out;  ///< page; empty: report.html next to the session
};

/// A session, and the documents that it was recorded with.
struct SessionOptions {
    std::string session;
    std::string procedure;  ///< empty: the shipped procedure with the same text
    std::string anatomy;    ///< empty: the anatomy that the procedure names
    std::vector<std::string> patches;
    std::vector<std::string> settings;
};

struct RemeshOptions : SessionOptions {
    std::string strategy;  ///< empty: the strategy that the procedure names, or else one that suits the tool
    std::string out;       ///< folder; empty: the session's folder
};

struct ViewOptions : SessionOptions {
    std::string at;                     ///< [s] shown first; empty: the start
    std::string screenshot;             ///< file of a picture, drawn without a window; empty: a window opens
    std::string frames;                 ///< folder of the pictures of a film, drawn without a window; empty: none
    bool is_recorded = false;           ///< from the session alone
    bool is_procedure_assumed = false;  ///< `procedure` is a guess: if it does not fit, the session alone is shown
    bool is_inspecting = false;         ///< shows the inspection of the law
    std::string language;               ///< of the procedure's words; empty: that of the environment
};

struct WindowOptions {
    std::string procedures;             ///< folder; empty: the shipped ones
    std::string attempts = "attempts";  ///< folder
    std::string learner;                ///< a code; empty: none
    std::string language{};             ///< of the procedures' words; empty: that of the environment
};

struct PrivacyOptions {
    std::vector<std::string> files;
    bool shows_values = false;
};

struct ListOptions {};

struct DevicesOptions {
    std::string action = "list";    ///< list | test | setup | doctor
    std::string device;             ///< of test and setup
    std::string record;             ///< of test: file for the motion of the handle; empty: none
    std::string duration = "10 s";  ///< of test
    bool is_with_force = false;     ///< of test: pushes, and lets a person confirm them, instead of measuring
};

struct DescribeOptions {
    std::string component;  ///< "PLUGIN" or "PLUGIN/COMPONENT"; empty: all
};

struct CheckOptions {
    std::vector<std::string> plugins;              ///< files
    int level = 3;                                 ///< 1 … 5
    std::string only;                              ///< a pattern on the ids of tests; empty: all
    std::vector<std::string> excluded, reasons;    ///< patterns, and the reason for each
    std::string twin;                              ///< the same plugin from another compiler
    std::vector<std::string> procedures;           ///< for level 5
    std::string format = "text";                   ///< text | json | junit
    std::string out;                               ///< file; empty: the report goes to stdout
    std::string accept, record, law, differences;  ///< acceptance files
};

struct NewOptions {
    std::string kind;  ///< plugin | procedure
    std::string name;
    std::string out;           ///< folder; empty: the name
    bool is_strategy = false;  ///< of a plugin
};

struct StabilityOptions {
    bool is_quick = false;
    std::string plugin = "kerf.drilling";  ///< the suite tests its first tool and force law
    std::string out;                       ///< folder; empty: out/stability
};

struct ChartOptions {
    bool is_quick = false;
    std::string scene;  ///< empty: all
    std::string out;    ///< folder; empty: out/chart
};

struct CompletionOptions {
    std::string shell;  ///< bash | zsh | fish
};

struct ManOptions {};

using Options = std::variant<RunOptions, ValidateOptions, RehearseOptions, ExpandOptions, PreviewOptions, PlanOptions,
                             ExplainOptions, SchemaOptions, ImportSourceOptions, AnatomyOptions, LandmarksOptions,
                             ReportOptions, RemeshOptions, ViewOptions, WindowOptions, PrivacyOptions, ListOptions,
                             DevicesOptions, DescribeOptions, CheckOptions, NewOptions, StabilityOptions, ChartOptions,
                             CompletionOptions, ManOptions>;

}  // namespace kerf::app
