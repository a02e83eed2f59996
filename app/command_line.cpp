// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/procedure/read_map.h"
#include "core/session/recorder.h"

namespace kerf {

namespace {

constexpr const char* hint_of_run =
    "Writes session.db, summary.json, report.html and bone.stl; bone-1.stl … if it came apart.\n"
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
    app.set_help_flag("-h,--help", "Say what there is");
    app.set_version_flag("--version", "kerf " KERF_VERSION)->description("Say which version this is");
    app.footer(std::string("`kerf COMMAND --help` tells more.\n") + notice_line + ".");
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
        add_option(command, "--variant", line.variant, "VARIANT", "One of the procedure's `variants:`",
                   not_empty("the id of a variant"));
        command
            ->add_option("--set", line.settings,
                         "Another value, as in `--set accuracy.spacing=0.5 mm`; as often as wanted")
            ->type_name("PATH=VALUE")
            ->check(is_setting())
            ->expected(1)
            ->take_all();
    };

    CLI::App* run = add("run", "Carry out a procedure, judge it and write what happened");
    add_files(run, "YAML file of the procedure", 1);
    add_option(run, "--anatomy", line.anatomy, "FILE", "Another anatomy than the procedure's own",
               not_empty(yaml_help));
    add_changes(run);
    add_option(run, "--hand", line.hand, "REHEARSAL",
               "The rehearsal that the simulated hand follows; if not given the first, or that of the recording",
               not_empty("the id of a rehearsal"));
    add_option(run, "--replay", line.replay, "SESSION", "The hand does what this session.db recorded, to the same bits",
               not_empty("the name of a session.db"));
    add_option(run, "-o,--out", line.out, "FOLDER",
               "Where to write; out/ and the procedure's id if not given. Replaces a run, nothing else",
               not_empty(out_help));
    add_option(run, "--learner", line.learner, "CODE", "A code, never a name", is_code());
    add_option(run, "--mode", line.mode, "MODE", "practice (if not given), exam or demo",
               one_of({"practice", "exam", "demo"}));
    run->add_flag("--headless", line.is_headless, "No window, which is how every run is for now");
    run->footer(std::string(hint_of_run) + "\n" + notice_line + ".");

    CLI::App* validate = add("validate", "Check procedures without running them");
    add_files(validate, "YAML files of procedures", many);
    add_option(validate, "--anatomy", line.anatomy, "FILE", "Another anatomy than the procedures' own",
               not_empty(yaml_help));
    add_option(validate, "--format", line.format, "FORMAT",
               "text (if not given) for people, json for programs, github for its annotations",
               one_of({"text", "json", "github"}));
    add_changes(validate);
    validate->add_flag("--bone", line.is_with_bone,
                       "Make the bone as well, and check what needs it: axes, scans, hands, the force scale");
    validate->footer(std::string("Exit code: 0 no errors, 2 errors.\n") + notice_line + ".");

    CLI::App* rehearse = add("rehearse", "Run every rehearsal and see whether it ends as it says");
    add_files(rehearse, "YAML files of procedures", many);
    add_option(rehearse, "--anatomy", line.anatomy, "FILE", "Another anatomy than the procedures' own",
               not_empty(yaml_help));

    add_changes(rehearse);
    rehearse->footer(
        std::string("Exit code: 0 all ended as they say, 1 one did not, 2 bad input, 3 fault or interrupted.\n") +
        notice_line + ".");

    CLI::App* expand = add("expand", "Print the procedure as a variant or `--set` makes it, with each value's origin");
    add_files(expand, "YAML file of the procedure", 1);
    add_changes(expand);

    CLI::App* describe = add("describe", "Tell every parameter, drive, signal and event of a component");
    describe->add_option("COMPONENT", line.component, "PLUGIN or PLUGIN/COMPONENT; all of them if not given")
        ->type_name("")
        ->check(not_empty("the name of a plugin, as `kerf list` shows it"));

    CLI::App* explain = add("explain", "Tell what a code like E0412 means, why, and what to do");
    explain->add_option("CODE", line.code, "as it stands before a message; all of them if not given")
        ->type_name("")
        ->check(not_empty("a code, as in `E0412`"));

    CLI::App* schema = add("schema", "Print the JSON Schema of a kind of document, for editors");
    schema->add_option("KIND", line.kind, "procedure (if not given) or anatomy")
        ->type_name("")
        ->check(one_of({"procedure", "anatomy"}));

    CLI::App* import =
        add("import", "Look at a scan or a surface: what was found, what would be done, what is doubted");
    import->add_option("SOURCE", line.source, "NIfTI, NRRD, MetaImage, a folder with DICOM; or STL, OBJ, PLY")
        ->type_name("")
        ->required()
        ->check(not_empty("the name of a file or folder"));
    add_option(import, "-o,--out", line.out, "FILE", "Writes it put straight: .nrrd for a scan, .stl for a surface",
               not_empty("a file, as in `--out bone.nrrd`"));
    add_option(import, "--series", line.series, "SERIES", "Which series of a folder with several",
               not_empty("a name that import offers"));
    add_option(import, "--acquisition", line.acquisition, "ACQUISITION",
               "Which acquisition of a series that shows the same part several times",
               not_empty("a name that import offers"));
    import->add_flag("--allow-resample", line.may_resample, "Fill gaps between slices from their neighbours");
    add_option(import, "--unit", line.unit, "UNIT", "What a 1 in a surface's file is: mm (if not given), cm, m or um",
               one_of({"mm", "cm", "m", "um"}));
    add_option(import, "--frame", line.frame, "FRAME",
               "Which way a surface's axes point: LPS or RAS; if not given as the file says, or else LPS",
               one_of({"LPS", "RAS"}));
    import->footer("Exit code: 0 if it can be used, 2 if it was refused.\n" + std::string(notice_line) + ".");

    CLI::App* anatomy =
        add("anatomy", "`kerf anatomy check A.yaml --for P.yaml`: hold an anatomy against its bone and a procedure");
    anatomy->add_option("ACTION", line.action, "check")->type_name("")->required()->check(one_of({"check"}));
    anatomy->add_option("ANATOMY", line.anatomy, "YAML file of the anatomy")
        ->type_name("")
        ->required()
        ->check(not_empty(yaml_help));
    anatomy->add_option("--for", line.files, "The procedure that it should serve")
        ->type_name("PROCEDURE")
        ->required()
        ->expected(1)
        ->check(not_empty(yaml_help));
    add_option(anatomy, "--format", line.format, "FORMAT", "text (if not given), json or github",
               one_of({"text", "json", "github"}));
    anatomy->footer("Exit code: 0 clean, 2 errors.\n" + std::string(notice_line) + ".");

    CLI::App* preview =
        add("preview",
            "Draw one page of a procedure before anything is cut: bone, zones, landmarks, the tool at each goal");
    add_files(preview, "YAML file of the procedure", 1);
    add_option(preview, "--anatomy", line.anatomy, "FILE", "Another anatomy than the procedure's own",
               not_empty(yaml_help));
    add_changes(preview);
    add_option(preview, "-o,--out", line.out, "FILE", "An .html file; out/ and the procedure's id if not given",
               not_empty("a file, as in `--out preview.html`"));

    CLI::App* report = add("report", "Write report.html again, from a session.db alone");
    report->add_option("SESSION", line.source, "session.db of a run; of one that was cut short, too")
        ->type_name("")
        ->required()
        ->check(not_empty("the name of a session.db"));
    add_option(report, "-o,--out", line.out, "FILE", "An .html file; report.html beside the session if not given",
               not_empty("a file, as in `--out report.html`"));

    CLI::App* privacy = add("privacy", "Tell what files would tell of a person: names, numbers, dates, paths");
    privacy->add_option("FILE", line.files, "DICOM, an image, or what Kerf has written")
        ->type_name("")
        ->required()
        ->check(not_empty("the name of a file"))
        ->expected(1, many);
    privacy->add_flag("--show", line.shows_values, "Print the values, not only their first letter");
    privacy->footer("Exit code: 0 if nothing was found, 1 if something was, 2 if a file cannot be read. Nobody can "
                    "promise that nothing else is in a file.\n" +
                    std::string(notice_line) + ".");

    CLI::App* plan = add("plan", "Find the least that each step needs: spacing, elements, features");
    add_files(plan, "YAML file of the procedure", 1);
    add_option(plan, "--anatomy", line.anatomy, "FILE", "Another anatomy than the procedure's own",
               not_empty(yaml_help));
    add_changes(plan);
    add_option(plan, "-o,--out", line.out, "FOLDER", "Where plan.txt and plan.csv go; nowhere if not given",
               not_empty(out_help));
    plan->footer("Holds to the procedure's `accuracy: {force: 7 %, volume: 2 %}` and `budget: {tick: 300 us}`, which "
                 "are the values if "
                 "it has none; the torque about the shaft counts as force does. Only for a budget that it has is "
                 "anything else looked for than the coarsest "
                 "that is accurate.\nExit code: 0 if a plan keeps both, 1 if none does.\n" +
                 std::string(notice_line) + ".");

    CLI::App* stability =
        add("stability", "Put the haptic loop where methods are known to fail, and print what it does");
    stability->add_flag("--quick", line.is_quick, "One device, two hands, one delay");
    add_option(stability, "--plugin", line.plugin, "PLUGIN",
               "Whose first tool and force are looked at; kerf.drilling if not given",
               not_empty("the name of a plugin, as `kerf list` shows it"));
    add_option(stability, "-o,--out", line.out, "FOLDER",
               "Where stability.csv and stability.svg go; out/stability if not given", not_empty(out_help));
    stability->footer(
        "Exit code: 0 if Kerf passes everywhere, 1 if it fails somewhere; what is rendered as printed may fail.\n" +
        std::string(notice_line) + ".");

    CLI::App* chart =
        add("chart", "Hold ways to make a drill's force against exact ones, and draw their error over their cost");
    chart->add_flag("--quick", line.is_quick,
                    "One scene unless --scene names another, two steps of each knob, one grid");
    add_option(chart, "--scene", line.scene, "SCENE", "Only this scene; all if not given",
               not_empty("the id of a scene"));
    add_option(chart, "-o,--out", line.out, "FOLDER",
               "Where chart.csv, chart.html and the pictures go; out/chart if not given", not_empty(out_help));

    add("list", "Name the tools and force models that were found");

    CLI::App* fresh = add("new", "Write the beginning of a plugin, a burr that builds and runs");
    CLI::App* fresh_plugin = fresh->add_subcommand("plugin", "Write a plugin into a folder of its own");
    fresh->require_subcommand(1);
    fresh_plugin->add_option("NAME", line.source, "Its name, as in `round_burr`")->type_name("")->required();
    add_option(fresh_plugin, "-o,--out", line.out, "FOLDER", "The folder to make; the name if not given",
               not_empty(out_help));
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
           : command->get_name() == "new"    ? "what? Write `kerf new plugin NAME`."
           : command->get_name() == "anatomy"
               ? "which anatomy, for which procedure? Write `kerf anatomy check ANATOMY.yaml --for PROCEDURE.yaml`."
               : "which procedure? Write " + quoted("kerf " + command->get_name() + " PROCEDURE.yaml") + ".";
}

}  // namespace

CommandLine read_command_line(int argc, const char* const* argv) {
    CommandLine line;
    CLI::App app("Kerf simulates bone surgery that can be felt.", "kerf");
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
        return answer("kerf: " + what + "\n" + quoted(help) + " tells what there is.\n", exit_bad_input);
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
