// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <utility>

#include "documents/yaml/read_map.h"
#include "session/recorder.h"

namespace kerf {

namespace {

constexpr const char* hint_of_run =
    "Writes session.db, summary.json, report.html and bone.stl; bone-1.stl … if it came apart,\n"
    "implant-1.stl … of what stays in it.\n"
    "Exit code: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault or interrupted.\n"
    "A replay: 1 too where nothing could be compared, 3 where it differs or its recording was changed.";

/// One of a few words, with a message that says which.
CLI::Validator one_of(const std::vector<std::string>& words) {
    return {[words](std::string& word) {
                const bool is_known = std::find(words.begin(), words.end(), word) != words.end();
                return is_known ? std::string() : "is `" + word + "`. Write " + listed(words) + ".";
            },
            ""};
}

/// Of letters, digits and a few signs: it stands in every session, so it must not be a name.
CLI::Validator is_code() {
    return {[](std::string& word) {
                const bool is_good =
                    !word.empty() && word.size() <= 64 && std::all_of(word.begin(), word.end(), [](unsigned char c) {
                        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                               c == '_' || c == '-';
                    });
                return is_good ? std::string()
                               : "must be a code of letters, digits, `.`, `_` and `-`, at most 64, and never a name. "
                                 "Write a code, as in `L17`.";
            },
            ""};
}

/// `path=value`: keys and ids with dots between them.
CLI::Validator is_setting() {
    return {[](std::string& word) {
                const std::size_t equals = word.find('=');
                const bool is_path = equals != std::string::npos && equals > 0 &&
                                     word.find_first_not_of(
                                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-") == equals;
                return is_path && equals + 1 < word.size() && word.find('\n') == std::string::npos
                           ? std::string()
                           : "is `" + word + "`. Write a path and a value, as in `--set accuracy.spacing=0.5 mm`.";
            },
            ""};
}

CLI::Validator not_empty(const std::string& what) {
    return {[what](std::string& word) { return word.empty() ? "is empty. Write " + what + "." : std::string(); }, ""};
}

/// The commands and options, bound to where their values go.
void describe_to(CLI::App& app, CommandLine& line) {
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    app.get_formatter()->label("REQUIRED", "");
    app.set_help_flag("-h,--help", "Print this help");
    app.set_version_flag("--version", "kerf " KERF_VERSION)->description("Print the version");
    app.footer(std::string("`kerf COMMAND --help` explains a command.\n") + notice_line + ".");
    app.require_subcommand(1);
    app.fallthrough();

    const std::string out_help = "a folder, as in `--out out/first`", yaml_help = "the name of a YAML file";
    const auto add = [&](const std::string& name, const std::string& help) {
        CLI::App* command = app.add_subcommand(name, help);
        command->footer(std::string(notice_line) + ".")->group("Commands");
        return command;
    };
    const auto add_option = [&](CLI::App* command, const char* name, std::string& value, const char* type,
                                const char* help, const CLI::Validator& check) {
        command->add_option(name, value, help)->type_name(type)->check(check);
    };
    const auto add_files = [&](CLI::App* command, const char* help, int most) {
        CLI::Option* files =
            command->add_option("PROCEDURE", line.files, help)->type_name("")->required()->check(not_empty(yaml_help));
        files->expected(1, most);
    };
    constexpr int many = 1000;
    const auto add_changes = [&](CLI::App* command) {
        add_option(command, "--variant", line.variant, "VARIANT", "Apply one of the procedure's `variants:`",
                   not_empty("the id of a variant"));
        command
            ->add_option("--set", line.settings,
                         "Change a value, as in `--set accuracy.spacing=0.5 mm`; may be repeated")
            ->type_name("PATH=VALUE")
            ->check(is_setting())
            ->expected(1)
            ->take_all();
    };

    CLI::App* run = add("run", "Run a procedure, assess it and write the results");
    add_files(run, "YAML file of the procedure", 1);
    add_option(run, "--anatomy", line.anatomy, "FILE", "Use this anatomy in place of the procedure's own",
               not_empty(yaml_help));
    add_changes(run);
    add_option(run, "--hand", line.hand, "REHEARSAL",
               "Rehearsal for the simulated hand; default: the first, or that of the recording",
               not_empty("the id of a rehearsal"));
    add_option(run, "--replay", line.replay, "SESSION", "Repeat the hand of this session.db, to the same bits",
               not_empty("the name of a session.db"));
    add_option(run, "-o,--out", line.out, "FOLDER",
               "Folder for the results; default: out/ and the procedure's id. Replaces an earlier run, nothing else",
               not_empty(out_help));
    add_option(run, "--learner", line.learner, "CODE", "Code of the trainee, never a name", is_code());
    add_option(run, "--mode", line.mode, "MODE", "practice (default), exam or demo",
               one_of({"practice", "exam", "demo"}));
    run->add_flag("--headless", line.is_headless, "Run without a window, as every run does at present");
    run->add_flag("--watch", line.is_watched,
                  "Run again whenever a plugin, the procedure or its anatomy changes, until Ctrl-C");
    run->footer(std::string(hint_of_run) + "\n" + notice_line + ".");

    CLI::App* validate = add("validate", "Check procedures without running them");
    add_files(validate, "YAML files of procedures", many);
    add_option(validate, "--anatomy", line.anatomy, "FILE", "Use this anatomy in place of the procedures' own",
               not_empty(yaml_help));
    add_option(validate, "--format", line.format, "FORMAT", "text (default), json, or github for its annotations",
               one_of({"text", "json", "github"}));
    add_changes(validate);
    validate->add_flag("--bone", line.is_with_bone,
                       "Make the bone too, and check what depends on it: axes, scans, hands, the force scale");
    validate->footer(std::string("Exit code: 0 no errors, 2 errors.\n") + notice_line + ".");

    CLI::App* rehearse = add("rehearse", "Run every rehearsal and compare its result with `expect:`");
    add_files(rehearse, "YAML files of procedures", many);
    add_option(rehearse, "--anatomy", line.anatomy, "FILE", "Use this anatomy in place of the procedures' own",
               not_empty(yaml_help));

    add_changes(rehearse);
    rehearse->footer(
        std::string("Exit code: 0 all ended as expected, 1 one did not, 2 bad input, 3 fault or interrupted.\n") +
        notice_line + ".");

    CLI::App* expand =
        add("expand", "Print the procedure with a variant and `--set` applied, and the origin of each value");
    add_files(expand, "YAML file of the procedure", 1);
    add_changes(expand);

    CLI::App* describe = add("describe", "Describe the parameters, drives, signals and events of components");
    describe->add_option("COMPONENT", line.component, "PLUGIN or PLUGIN/COMPONENT; default: all")
        ->type_name("")
        ->check(not_empty("the name of a plugin, as `kerf list` shows it"));

    CLI::App* explain = add("explain", "Explain a code such as E0412: its meaning, its reason, what to do");
    explain->add_option("CODE", line.code, "the code before a message; default: a list of all")
        ->type_name("")
        ->check(not_empty("a code, as in `E0412`"));

    CLI::App* schema = add("schema", "Print the JSON Schema of a kind of document, for editors");
    schema->add_option("KIND", line.kind, "procedure (default) or anatomy")
        ->type_name("")
        ->check(one_of({"procedure", "anatomy"}));

    CLI::App* import = add("import", "Check a scan or a surface: its properties, the processing, and doubts");
    import->add_option("SOURCE", line.source, "NIfTI, NRRD, MetaImage, a folder with DICOM; or STL, OBJ, PLY")
        ->type_name("")
        ->required()
        ->check(not_empty("the name of a file or folder"));
    add_option(import, "-o,--out", line.out, "FILE", "Write the processed data: .nrrd for a scan, .stl for a surface",
               not_empty("a file, as in `--out bone.nrrd`"));
    add_option(import, "--series", line.series, "SERIES", "Series of a folder that holds several",
               not_empty("a name that import offers"));
    add_option(import, "--acquisition", line.acquisition, "ACQUISITION",
               "Which acquisition of a series that shows the same part several times",
               not_empty("a name that import offers"));
    import->add_flag("--allow-resample", line.may_resample, "Fill gaps between slices from their neighbours");
    add_option(import, "--unit", line.unit, "UNIT", "Unit of a surface's coordinates: mm (default), cm, m or um",
               one_of({"mm", "cm", "m", "um"}));
    add_option(import, "--frame", line.frame, "FRAME",
               "Frame of a surface: LPS or RAS; default: what the file names, or else LPS", one_of({"LPS", "RAS"}));
    import->footer("Exit code: 0 usable, 2 refused.\n" + std::string(notice_line) + ".");

    CLI::App* anatomy =
        add("anatomy", "`kerf anatomy check A.yaml --for P.yaml`: check an anatomy with its bone and a procedure");
    anatomy->add_option("ACTION", line.action, "check")->type_name("")->required()->check(one_of({"check"}));
    anatomy->add_option("ANATOMY", line.anatomy, "YAML file of the anatomy")
        ->type_name("")
        ->required()
        ->check(not_empty(yaml_help));
    anatomy->add_option("--for", line.files, "Procedure that the anatomy is for")
        ->type_name("PROCEDURE")
        ->required()
        ->expected(1)
        ->check(not_empty(yaml_help));
    add_option(anatomy, "--format", line.format, "FORMAT", "text (default), json or github",
               one_of({"text", "json", "github"}));
    anatomy->footer("Exit code: 0 clean, 2 errors.\n" + std::string(notice_line) + ".");

    CLI::App* preview =
        add("preview",
            "Write a page that shows a procedure before it is run: bone, zones, landmarks, the tool at each goal");
    add_files(preview, "YAML file of the procedure", 1);
    add_option(preview, "--anatomy", line.anatomy, "FILE", "Use this anatomy in place of the procedure's own",
               not_empty(yaml_help));
    add_changes(preview);
    add_option(preview, "-o,--out", line.out, "FILE", "An .html file; default: out/ and the procedure's id",
               not_empty("a file, as in `--out preview.html`"));

    CLI::App* report = add("report", "Write report.html again from a session.db");
    report->add_option("SESSION", line.source, "session.db of a run, complete or not")
        ->type_name("")
        ->required()
        ->check(not_empty("the name of a session.db"));
    add_option(report, "-o,--out", line.out, "FILE", "An .html file; default: report.html in the session's folder",
               not_empty("a file, as in `--out report.html`"));

    CLI::App* remesh = add("remesh", "Make the exact surface of what a session left: bone-exact.stl, remesh.json");
    remesh->add_option("SESSION", line.source, "session.db of a run")
        ->type_name("")
        ->required()
        ->check(not_empty("the name of a session.db"));
    remesh->add_option("--procedure", line.files, "Its procedure; default: the shipped one with its text")
        ->type_name("PROCEDURE")
        ->check(not_empty(yaml_help))
        ->expected(1);
    add_option(remesh, "--anatomy", line.anatomy, "FILE", "The anatomy it was run with, if not the procedure's own",
               not_empty(yaml_help));
    remesh->add_option("--set", line.settings, "The `--set` it was run with; may be repeated")
        ->type_name("PATH=VALUE")
        ->check(is_setting())
        ->expected(1)
        ->take_all();
    add_option(remesh, "--strategy", line.strategy, "STRATEGY",
               "For all tools; `kerf list` names them. Default: what the procedure names, or else what suits the tool",
               not_empty("a strategy, as `example.burring.groove`"));
    add_option(remesh, "-o,--out", line.out, "FOLDER", "Folder for the results; default: that of the session",
               not_empty(out_help));
    remesh->footer(std::string("Exit code: 0 made, 2 bad input, 3 no exact surface could be made.\n") + notice_line +
                   ".");

    CLI::App* privacy = add("privacy", "List personal data in files: names, numbers, dates, paths");
    privacy->add_option("FILE", line.files, "DICOM, an image, or a file of Kerf")
        ->type_name("")
        ->required()
        ->check(not_empty("the name of a file"))
        ->expected(1, many);
    privacy->add_flag("--show", line.shows_values, "Print the values, not only their first letters");
    privacy->footer("Exit code: 0 nothing found, 1 something found, 2 a file cannot be read. The list may be "
                    "incomplete.\n" +
                    std::string(notice_line) + ".");

    CLI::App* plan = add("plan", "Find the coarsest settings that each step allows: spacing, elements, features");
    add_files(plan, "YAML file of the procedure", 1);
    add_option(plan, "--anatomy", line.anatomy, "FILE", "Use this anatomy in place of the procedure's own",
               not_empty(yaml_help));
    add_changes(plan);
    add_option(plan, "-o,--out", line.out, "FOLDER", "Folder for plan.txt and plan.csv; default: none is written",
               not_empty(out_help));
    plan->footer("Keeps the procedure's `accuracy: {force: 7 %, volume: 2 %}` and `budget: {tick: 300 us}`; these are "
                 "the defaults. Torque about the shaft counts as force. Without a `budget:` the result is the coarsest "
                 "accurate setting.\nExit code: 0 a plan keeps both, 1 none does.\n" +
                 std::string(notice_line) + ".");

    CLI::App* stability = add("stability", "Test the haptic loop under conditions in which published methods fail");
    stability->add_flag("--quick", line.is_quick, "Test one device, two hands and one delay");
    add_option(stability, "--plugin", line.plugin, "PLUGIN",
               "Plugin whose first tool and force are tested; default: kerf.drilling",
               not_empty("the name of a plugin, as `kerf list` shows it"));
    add_option(stability, "-o,--out", line.out, "FOLDER",
               "Folder for stability.csv and stability.svg; default: out/stability", not_empty(out_help));
    stability->footer("Exit code: 0 Kerf passes all tests, 1 it fails one. Published methods may fail.\n" +
                      std::string(notice_line) + ".");

    CLI::App* chart = add(
        "chart", "Compare methods for the force of drill, burr and saw with exact ones, and plot error against cost");
    chart->add_flag("--quick", line.is_quick, "One scene, or that of --scene; two values of each setting; one grid");
    add_option(chart, "--scene", line.scene, "SCENE", "Only this scene; default: all", not_empty("the id of a scene"));
    add_option(chart, "-o,--out", line.out, "FOLDER",
               "Folder for chart.csv, chart.html and the pictures; default: out/chart", not_empty(out_help));

    add("list", "List the tools, force laws and remeshing strategies of all plugins");

    CLI::App* check = add("check", "Test plugins for conformance: tables, geometry, laws, real time, physics");
    check->add_option("PLUGIN", line.files, "Shared libraries of plugins")
        ->type_name("")
        ->required()
        ->check(not_empty("the file of a plugin, as in `build/lib/kerf/kerf_peck.so`"))
        ->expected(1, many);
    check
        ->add_option("--level", line.level,
                     "1 loads and describes, 2 and geometry, 3 and laws (default), 4 and physics, 5 and procedures")
        ->type_name("LEVEL")
        ->check(CLI::Validator(
            [](std::string& word) {
                return word.size() == 1 && word[0] >= '1' && word[0] <= '5'
                           ? std::string()
                           : "is `" + word + "`. Write 1, 2, 3, 4 or 5.";
            },
            ""));
    add_option(check, "--only", line.only, "PATTERN", "Only tests whose id matches this regular expression",
               not_empty("a regular expression, as in `law`"));
    check->add_option("--exclude", line.excluded, "Leave out tests whose id matches; each with its --reason")
        ->type_name("PATTERN")
        ->check(not_empty("a regular expression, as in `^law\\.time$`"))
        ->expected(1)
        ->take_all();
    check->add_option("--reason", line.reasons, "Why they are left out; the report shows it")
        ->type_name("TEXT")
        ->check(not_empty("a reason"))
        ->expected(1)
        ->take_all();
    add_option(check, "--twin", line.twin, "PLUGIN",
               "At level 5: the same plugin from another compiler, which must give the same bits",
               not_empty("the file of a plugin"));
    check
        ->add_option("--procedure", line.procedures,
                     "At level 5: run these; default: the shipped procedures that use the plugin")
        ->type_name("PROCEDURE")
        ->check(not_empty(yaml_help))
        ->expected(1)
        ->take_all();
    add_option(check, "--format", line.format, "FORMAT", "text (default), json or junit",
               one_of({"text", "json", "junit"}));
    add_option(check, "-o,--out", line.out, "FILE", "Write the report to this file; text still goes to the terminal",
               not_empty("a file, as in `--out check.xml`"));
    add_option(
        check, "--accept", line.accept, "FILE",
        "Lead the law along this file's script and compare its forces with those recorded, in place of the tests",
        not_empty("an acceptance file, as in `--accept peck.csv`"));
    add_option(check, "--record", line.record, "FILE",
               "Record an acceptance file; one that is there gives the script, else a standard one is taken",
               not_empty("a file, as in `--record peck.csv`"));
    add_option(check, "--law", line.law, "LAW", "Of --accept and --record: which law, as in 'burr with burring'",
               not_empty("a tool and a law, as in `--law 'burr with burring'`"));
    add_option(check, "--differences", line.differences, "FOLDER",
               "Of --accept: folder for the differences as CSV and picture; default: out/check", not_empty(out_help));
    check->footer("Exit code: 0 no test failed, 1 one failed, 2 bad input, 3 fault or interrupted.\n" +
                  std::string(notice_line) + ".");

    CLI::App* fresh =
        add("new", "Write the beginning of a plugin that builds and runs: a burr, or a remeshing strategy");
    CLI::App* fresh_plugin = fresh->add_subcommand("plugin", "Write a plugin into a folder of its own");
    fresh->require_subcommand(1);
    fresh_plugin->add_option("NAME", line.source, "Its name, as in `round_burr`")->type_name("")->required();
    add_option(fresh_plugin, "-o,--out", line.out, "FOLDER", "The folder to make; the name if not given",
               not_empty(out_help));
    fresh_plugin->add_flag("--strategy", line.has_strategy, "A remeshing strategy, in place of a tool with its law");
}

std::string quoted(const std::string& word) { return "`" + word + "`"; }

/// An argument that nothing expects.
std::string about_extra(const std::string& word, const CLI::App& app, const CLI::App* command) {
    const bool is_option = word.size() > 1 && word[0] == '-';
    std::vector<std::string> known;
    if (!is_option && command == nullptr) {
        for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
            known.push_back(sub->get_name());
        const std::string meant = closest(word, known);
        return "there is no command " + quoted(word) + ". Write " +
               (meant.empty() ? listed(known) : quoted("kerf " + meant)) + ".";
    }
    if (!is_option) return quoted(word) + " is one argument too many.";
    for (const CLI::App* level : {command, &app})
        if (level != nullptr)
            for (const CLI::Option* option :
                 level->get_options([](const CLI::Option* o) { return o->nonpositional(); }))
                if (const std::string name = "--" + option->get_lnames().front();
                    std::find(known.begin(), known.end(), name) == known.end())
                    known.push_back(name);
    const std::string given = word.substr(0, word.find('='));
    const std::string meant = closest(given, known);
    return "there is no option " + quoted(given) +
           (command != nullptr ? " of " + quoted("kerf " + command->get_name()) : "") + ". Write " +
           (meant.empty() ? listed(known) : quoted(meant)) + ".";
}

/// An option or argument that came too often, without its value, or with one that it cannot take.
std::string about_value(const CLI::ParseError& error, const CLI::App* command) {
    const std::string what = error.what();
    const std::size_t end = what.find(": ");
    const std::string name = what.substr(0, end);
    const CLI::Option* option = command != nullptr ? command->get_option_no_throw(name) : nullptr;
    if (end == std::string::npos || option == nullptr) return what + ".";
    const std::vector<std::string>& values = option->results();
    const bool is_mismatch = dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr;
    if (is_mismatch && values.size() > 1 && option->get_positional())
        return quoted("kerf " + command->get_name()) + " takes one procedure; " + quoted(values[1]) +
               " is the second. Run them one by one.";
    if (is_mismatch && values.size() > 1)
        return quoted(name) + " is given " + std::to_string(values.size()) + " times. Write it once.";
    if (is_mismatch)
        return quoted(name) + " needs a value. Write " + quoted(name + " " + option->get_type_name()) + ".";
    return quoted(name) + " " + what.substr(end + 2);
}

/// What is wrong, in our words where the library's are not for people.
std::string about(const CLI::ParseError& error, const CLI::App& app, const CLI::App* command) {
    const std::vector<std::string> extras = app.remaining(true);  // first: it may be why something else is missing
    if (const auto unknown = std::find_if(extras.begin(), extras.end(), [](const std::string& e) { return e != "--"; });
        unknown != extras.end())
        return about_extra(*unknown, app, command);
    if (dynamic_cast<const CLI::RequiredError*>(&error) == nullptr) return about_value(error, command);
    return command == nullptr                ? "nothing to do. Write `kerf run PROCEDURE.yaml`, or another command."
           : command->get_name() == "import" ? "what? Write `kerf import SCAN`, with a file or a folder."
           : command->get_name() == "report" ? "of which run? Write `kerf report SESSION.db`."
           : command->get_name() == "remesh" ? "of which run? Write `kerf remesh SESSION.db`."
           : command->get_name() == "check"  ? "which plugin? Write `kerf check PLUGIN.so`."
           : command->get_name() == "new"    ? "what? Write `kerf new plugin NAME`."
           : command->get_name() == "anatomy"
               ? "which anatomy, for which procedure? Write `kerf anatomy check ANATOMY.yaml --for PROCEDURE.yaml`."
               : "which procedure? Write " + quoted("kerf " + command->get_name() + " PROCEDURE.yaml") + ".";
}

}  // namespace

CommandLine read_command_line(int argc, const char* const* argv) {
    CommandLine line;
    CLI::App app("Kerf: haptic simulation of bone surgery.", "kerf");
    describe_to(app, line);
    const auto answer = [](std::string text, int exit_code) {
        CommandLine only;
        only.answer = std::move(text);
        only.exit_code = exit_code;
        return only;
    };
    const auto command = [&]() -> const CLI::App* {
        const auto given = app.get_subcommands();
        return given.empty() ? nullptr : given.front();
    };
    const auto wrong = [&](const std::string& what) {
        const std::string help = command() != nullptr ? "kerf " + command()->get_name() + " --help" : "kerf --help";
        return answer("kerf: " + what + "\n" + quoted(help) + " lists the choices.\n", exit_bad_input);
    };
    if (argc <= 1) return answer(app.help(), exit_bad_input);
    std::vector<std::string> words(argv + 1, argv + argc);
    if (words.front() == "help") words.front() = "--help";
    std::reverse(words.begin(), words.end());  // as the library takes them
    try {
        app.parse(std::move(words));
    } catch (const CLI::CallForHelp&) {
        return answer(app.help(), exit_pass);
    } catch (const CLI::CallForVersion& version) {
        return answer(std::string(version.what()) + "\n", exit_pass);
    } catch (const CLI::ParseError& error) {
        return wrong(about(error, app, command()));
    }
    line.command = command()->get_name();
    return line;
}

}  // namespace kerf
