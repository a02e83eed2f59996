// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "app/learner_code.h"
#include "documents/yaml/read_map.h"
#include "run/shipped.h"
#include "session/recorder.h"
#include "text/file_kind.h"
#include "text/shell.h"

namespace kerf::app {

namespace {

constexpr int max_values = 1000;  // of an argument that takes several

// ---- checks of values --------------------------------------------------------------------------------------------

/// Keys and ids with dots between them, then a value. A number in brackets is refused where the ids are known.
bool is_setting(const std::string& word) {
    const std::size_t equals = word.find('=');
    const bool is_path =
        equals != std::string::npos && equals > 0 &&
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-[]") == equals;
    return is_path && equals + 1 < word.size() && word.find('\n') == std::string::npos;
}

std::string numbers_of(const Value& value) {
    std::string text = std::to_string(value.min);
    for (int n = value.min + 1; n <= value.max; ++n) text += (n == value.max ? " or " : ", ") + std::to_string(n);
    return text;
}

bool is_number(const Value& value, const std::string& word) {
    for (int n = value.min; n <= value.max; ++n)
        if (word == std::to_string(n)) return true;
    return false;
}

/// Returns what is wrong with the name of a session, behind the name of its parameter; empty if nothing is.
std::string complaint_about_session(const Parameter& parameter, const std::string& command, std::string word) {
    if (text::recognise(word).kind != text::FileKind::run_folder) return {};
    while (word.size() > 1 && word.back() == '/') word.pop_back();
    const std::string file = text::shell_path(word + "/session.db");
    return "is of another kind: got the folder of a run, expected the session.db of a run. Write `" +
           (parameter.is_option() ? parameter.name : "kerf " + command) + " " + file + "`.";
}

/// Returns what is wrong with a value, behind its name; empty if nothing is.
std::string complaint_about(const Value& value, const std::string& word) {
    switch (value.kind) {
        case ValueKind::none:
        case ValueKind::any:
            return {};
        case ValueKind::text:
        case ValueKind::file:
        case ValueKind::folder:
            return word.empty() ? "is empty. Write " + value.expects + "." : std::string();
        case ValueKind::words: {
            const bool is_known = std::find(value.words.begin(), value.words.end(), word) != value.words.end();
            if (is_known) return {};
            const std::string meant = documents::closest(word, value.words),
                              known = documents::listed(value.words, word);
            return "is `" + word +
                   (meant.empty() ? "`. Write " + known : "`, expected " + known + ". Write `" + meant + "`") + ".";
        }
        case ValueKind::number:
            return is_number(value, word) ? std::string() : "is `" + word + "`. Write " + numbers_of(value) + ".";
        case ValueKind::code:  // it is part of every session, so it must not be a name
            return is_code(word) ? std::string() : code_rule;
        case ValueKind::setting:
            return is_setting(word)
                       ? std::string()
                       : "is `" + word + "`. Write a path and a value, as in `--set accuracy.spacing=0.5 mm`.";
    }
    return {};
}

// ---- the table, for the parser -----------------------------------------------------------------------------------

/// The library's help, with `PLUGIN...` for an argument that takes several values.
class HelpFormatter final : public CLI::Formatter {
public:
    HelpFormatter() {
        label("SUBCOMMAND", "COMMAND");
        label("REQUIRED", "");
    }
    std::string make_option_usage(const CLI::Option* option) const override {
        const std::string name = option->get_name(true) + (option->get_items_expected_max() > 1 ? "..." : "");
        return option->get_required() ? name : "[" + name + "]";
    }
};

void add_parameter(CLI::App& app, const Parameter& parameter, const Command& command, Options& options) {
    const std::string names =
        parameter.short_name.empty() ? parameter.name : parameter.short_name + "," + parameter.name;
    const std::string help = help_text(parameter);
    const Member member = parameter.member(options);
    if (const auto* flag = std::get_if<bool*>(&member)) {
        app.add_flag(names, **flag, help);
        return;
    }
    CLI::Option* added = nullptr;
    if (const auto* word = std::get_if<std::string*>(&member)) added = app.add_option(names, **word, help);
    if (const auto* number = std::get_if<int*>(&member)) added = app.add_option(names, **number, help);
    if (const auto* words = std::get_if<std::vector<std::string>*>(&member)) {
        added = app.add_option(names, **words, help);
        if (parameter.is_option())
            added->expected(1)->take_all()->allow_extra_args(false);  // a procedure may follow
        else
            added->expected(1, max_values);
    }
    added->type_name(parameter.is_option() ? parameter.value.placeholder : "")->required(parameter.is_required);
    added->check(CLI::Validator(
        [&parameter, &command](std::string& word) {
            const std::string complaint =
                parameter.value.suffix == ".db" ? complaint_about_session(parameter, command.name, word) : "";
            return complaint.empty() ? complaint_about(parameter.value, word) : complaint;
        },
        ""));
}

std::string examples_text(const Command& command) {
    std::string text;
    for (const Example& example : command.examples) text += "  " + example.line + "\n      " + example.what + "\n";
    return text.empty() ? text : "Examples:\n" + text + "\n";
}

/// Adds a command. `options` outlives the parser, which fills it.
void add_command(CLI::App& app, const Command& command, Options& options) {
    const std::string notice = std::string(session::notice_line) + ".";
    CLI::App* with_parameters = app.add_subcommand(command.name, command.summary);
    with_parameters->group(command.group)->footer(notice);
    with_parameters->footer(examples_text(command) + (command.footer.empty() ? "" : command.footer + "\n") + notice);
    for (const Parameter& argument : command.arguments) add_parameter(*with_parameters, argument, command, options);
    for (const Parameter& option : command.options) add_parameter(*with_parameters, option, command, options);
}

void prepare(CLI::App& app) {
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", help_summary);
    app.set_version_flag("--version", "kerf " KERF_VERSION)->description(version_summary);
    app.footer(std::string("`kerf COMMAND --help` explains a command.\n") + session::notice_line + ".");
    app.require_subcommand(1);
    app.fallthrough();
}

// ---- messages ----------------------------------------------------------------------------------------------------

std::string quoted(const std::string& word) { return "`" + word + "`"; }

/// Returns whether one word may be a slip of the other: it has the same first letter, or one letter less or other at
/// its beginning. `export` is none of `import`.
bool may_be_slip(const std::string& word, const std::string& command) {
    if (word.empty() || word[0] == command[0]) return true;
    return word.substr(1) == command.substr(1) || word == command.substr(1) || word.substr(1) == command ||
           (word.size() > 1 && word[0] == command[1] && word[1] == command[0]);
}

std::string about_unknown_command(const std::string& word) {
    std::vector<std::string> known, near;
    for (const Command& command : command_table()) {
        known.push_back(command.name);
        if (may_be_slip(word, command.name)) near.push_back(command.name);
    }
    const std::string meant = documents::closest(word, near);
    return "there is no command " + quoted(word) + ". Write " +
           (meant.empty() ? documents::listed(known, word) : quoted("kerf " + meant)) + ".";
}

std::string about_unknown_option(const std::string& word, const Command* command) {
    std::vector<std::string> known{"--help"};
    if (command != nullptr)
        for (const Parameter& option : command->options) known.push_back(option.name);
    known.emplace_back("--version");
    const std::string given = word.substr(0, word.find('='));
    return "there is no option " + quoted(given) +
           (command != nullptr ? " of " + quoted("kerf " + command->name) : "") + ". " +
           documents::write_instead(given, known);
}

/// An argument that nothing expects.
std::string about_extra(const std::string& word, const Command* command) {
    if (word.size() > 1 && word[0] == '-') return about_unknown_option(word, command);
    if (command == nullptr) return about_unknown_command(word);
    const auto takes_one_procedure = [&](const Parameter& argument) {
        return argument.name == "PROCEDURE" && !command->has_many(argument);
    };
    if (std::any_of(command->arguments.begin(), command->arguments.end(), takes_one_procedure))
        return quoted("kerf " + command->name) + " takes one procedure; " + quoted(word) +
               " is the second. Run them one by one.";
    return quoted(word) + " is one argument too many.";
}

/// An option or argument that was given too often, without its value, or with one that it cannot take.
std::string about_value(const CLI::ParseError& error, const CLI::App* command) {
    const std::string what = error.what();
    const std::size_t end = what.find(": ");
    const std::string name = what.substr(0, end);
    const CLI::Option* option = command != nullptr ? command->get_option_no_throw(name) : nullptr;
    if (end == std::string::npos || option == nullptr) return what + ".";
    const std::vector<std::string>& values = option->results();
    const bool is_mismatch = dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr;
    if (is_mismatch && values.size() > 1)
        return quoted(name) + " is given " + std::to_string(values.size()) + " times. Write it once.";
    if (is_mismatch)
        return quoted(name) + " needs a value. Write " + quoted(name + " " + option->get_type_name()) + ".";
    return quoted(name) + " " + what.substr(end + 2);
}

/// The subcommand that was given, as deep as it goes; null if there is none.
const CLI::App* innermost(const CLI::App& app) {
    const CLI::App* found = nullptr;
    for (auto given = app.get_subcommands(); !given.empty(); given = found->get_subcommands()) found = given.front();
    return found;
}

/// Returns what is wrong, in Kerf's words instead of the library's.
std::string about(const CLI::ParseError& error, const CLI::App& app, const Command* command) {
    const std::vector<std::string> extras = app.remaining(true);  // first: it may be why something else is missing
    if (const auto unknown = std::find_if(extras.begin(), extras.end(), [](const std::string& e) { return e != "--"; });
        unknown != extras.end())
        return about_extra(*unknown, command);
    if (dynamic_cast<const CLI::RequiredError*>(&error) == nullptr) return about_value(error, innermost(app));
    return command == nullptr ? "nothing to do. Write `kerf run PROCEDURE.yaml`, or another command."
                              : command->when_missing;
}

CommandLine answer(std::string text, ExitCode exit_code) {
    CommandLine only;
    only.answer = std::move(text);
    only.exit_code = exit_code;
    return only;
}

}  // namespace

CommandLine read_command_line(int argc, const char* const* argv) {
    CLI::App app(program_summary, "kerf");
    prepare(app);
    const std::vector<Command>& table = command_table();
    std::vector<Options> options;  // of each command; never resized below, for the parser has addresses in it
    for (const Command& command : table) options.push_back(command.defaults);
    for (std::size_t i = 0; i < table.size(); ++i) add_command(app, table[i], options[i]);
    const auto given = [&]() -> const Command* {
        const auto commands = app.get_subcommands();
        return commands.empty() ? nullptr : find_command(commands.front()->get_name());
    };

    if (argc <= 1) return answer(app.help(), exit_pass);
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
        const std::string help = given() != nullptr ? "kerf " + given()->name + " --help" : "kerf --help";
        return answer("kerf: " + about(error, app, given()) + "\n" + quoted(help) + " lists the choices.\n",
                      exit_bad_input);
    }
    CommandLine line;
    line.command = given();
    line.options = std::move(options[static_cast<std::size_t>(line.command - table.data())]);
    return line;
}

void resolve_shipped_files(CommandLine& line, const std::string& shipped) {
    const auto resolve = [&](const Parameter& parameter) {
        if (!parameter.value.may_be_shipped) return;
        const Member member = parameter.member(line.options);
        if (auto* const* file = std::get_if<std::string*>(&member)) **file = run::shipped_or_own(**file, shipped);
        if (auto* const* files = std::get_if<std::vector<std::string>*>(&member))
            for (std::string& file : **files) file = run::shipped_or_own(file, shipped);
    };
    for (const Parameter& argument : line.command->arguments) resolve(argument);
    for (const Parameter& option : line.command->options) resolve(option);
}

}  // namespace kerf::app
