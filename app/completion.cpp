// SPDX-License-Identifier: Apache-2.0
#include "app/completion.h"

#include <cstddef>
#include <vector>

#include "app/command_table.h"

namespace kerf::app {

namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::vector<std::string> names_of(const Parameter& option) {
    return option.short_name.empty() ? std::vector{option.name} : std::vector{option.name, option.short_name};
}

/// Whether the last argument takes all words that follow.
bool is_last_repeated(const Command& command) {
    return !command.arguments.empty() && command.has_many(command.arguments.back());
}

std::string command_names() {
    std::vector<std::string> names;
    for (const Command& command : command_table()) names.push_back(command.name);
    return joined(names);
}

// ---- bash --------------------------------------------------------------------------------------------------------

/// Finds the command, then the option or the argument at the cursor. `kind` describes its value.
constexpr const char* bash_body = R"bash(
_kerf_offer() {
    local suffix
    case $kind in
        words*) mapfile -t COMPREPLY < <(compgen -W "${kind#words}" -- "$current") ;;
        folder)
            compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -d -- "$current")
            ;;
        file*)
            suffix=${kind#file}
            compopt -o filenames 2>/dev/null
            if [[ -z $suffix ]]; then
                mapfile -t COMPREPLY < <(compgen -f -- "$current")
            else
                mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X "!*$suffix" -- "$current")
            fi
            ;;
    esac
}

_kerf() {
    local current=${COMP_WORDS[COMP_CWORD]} command= word option= kind= count=0 index
    COMPREPLY=()
    for ((index = 1; index < COMP_CWORD; ++index)); do
        word=${COMP_WORDS[index]}
        if [[ -n $option ]]; then
            [[ $word == = ]] || option=   # bash splits --out=FOLDER into three words
        elif [[ $word == -* ]]; then
            if _kerf_option "$command" "$word"; then option=$word; fi
        elif [[ -z $command ]]; then
            command=$word
        else
            ((++count))
        fi
    done
    if [[ -n $option ]]; then
        if [[ $current == = ]]; then current=; fi
        _kerf_option "$command" "$option"
        _kerf_offer
    elif [[ $current == -* ]]; then
        _kerf_options "$command"
        _kerf_offer
    elif _kerf_argument "$command" "$count"; then
        _kerf_offer
    fi
}

complete -F _kerf kerf
)bash";

std::string bash_kind(const Value& value) {
    switch (value.kind) {
        case ValueKind::words:
            return "words " + joined(value.words);
        case ValueKind::number: {
            std::string text = "words";
            for (int n = value.min; n <= value.max; ++n) text += " " + std::to_string(n);
            return text;
        }
        case ValueKind::file:
            return "file" + value.suffix;
        case ValueKind::folder:
            return "folder";
        default:
            return "none";
    }
}

std::string bash_script() {
    std::string values, options, arguments;
    for (const Command& command : command_table()) {
        std::string names;
        for (const Parameter& option : command.options) {
            names += option.name + " ";
            if (option.is_flag()) continue;
            std::string patterns;
            for (const std::string& name : names_of(option))
                patterns += (patterns.empty() ? "'" : " | '") + command.name + " " + name + "'";
            values += "        " + patterns + ") kind='" + bash_kind(option.value) + "' ;;\n";
        }
        options += "        " + command.name + ") kind='words " + names + "--help' ;;\n";
        const std::vector<Parameter>& typed = command.arguments;
        for (std::size_t n = 0; n < typed.size(); ++n) {
            const bool is_rest = n + 1 == typed.size() && is_last_repeated(command);
            arguments += "        '" + command.name + " " + (is_rest ? "'*" : std::to_string(n) + "'") + ") kind='" +
                         bash_kind(typed[n].value) + "' ;;\n";
        }
    }
    const std::string commands = "kind='words " + command_names() + "' ;;\n";
    return "# Completes the command line of kerf in bash. `kerf completion bash` prints this.\n\n"
           "# _kerf_option COMMAND OPTION: sets the kind of its value; fails if the option has none.\n"
           "_kerf_option() {\n    case \"$1 $2\" in\n" +
           values +
           "        *) return 1 ;;\n    esac\n}\n\n"
           "# _kerf_options COMMAND\n_kerf_options() {\n    case $1 in\n" +
           options +
           "        *) kind='words --help --version' ;;\n    esac\n}\n\n"
           "# _kerf_argument COMMAND NUMBER: sets the kind of the argument; fails if there is none.\n"
           "_kerf_argument() {\n    case \"$1 $2\" in\n        ' 0') " +
           commands + "        'help 0') " + commands + arguments + "        *) return 1 ;;\n    esac\n}\n" + bash_body;
}

// ---- zsh ---------------------------------------------------------------------------------------------------------

/// Replaces each of `characters` by itself behind a backslash.
std::string escaped(const std::string& text, const std::string& characters) {
    std::string safe;
    for (const char c : text) {
        if (characters.find(c) != std::string::npos) safe += '\\';
        safe += c;
    }
    return safe;
}

/// In single quotes of zsh, as of any POSIX shell.
std::string zsh_quoted(const std::string& text) {
    std::string safe = "'";
    for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return safe + "'";
}

std::string zsh_action(const Value& value) {
    switch (value.kind) {
        case ValueKind::words:
            return "(" + joined(value.words) + ")";
        case ValueKind::number: {
            std::vector<std::string> numbers;
            for (int n = value.min; n <= value.max; ++n) numbers.push_back(std::to_string(n));
            return "(" + joined(numbers) + ")";
        }
        case ValueKind::file:
            return value.suffix.empty() ? "_files" : "_files -g \"*" + value.suffix + "\"";
        case ValueKind::folder:
            return "_files -/";
        default:
            return " ";
    }
}

std::string zsh_option(const Command& command, const Parameter& option, const std::string& name) {
    const std::string repeated = !option.is_flag() && command.has_many(option) ? "*" : "";
    const std::string excluded =
        repeated.empty() && !option.short_name.empty() ? "(" + option.short_name + " " + option.name + ")" : "";
    std::string text = repeated + excluded + name + "[" + escaped(help_text(option), "[]:") + "]";
    if (!option.is_flag()) text += ":" + option.value.placeholder + ":" + zsh_action(option.value);
    return zsh_quoted(text);
}

std::string zsh_script() {
    std::string commands, cases;
    for (const Command& command : command_table()) {
        commands += "        " + zsh_quoted(command.name + ":" + command.summary) + "\n";
        cases += "                " + command.name + ")\n                    _arguments " +
                 zsh_quoted(std::string("(- *)--help[") + help_summary + "]");
        for (const Parameter& option : command.options)
            for (const std::string& name : names_of(option))
                cases += " \\\n                        " + zsh_option(command, option, name);
        const std::vector<Parameter>& typed = command.arguments;
        for (std::size_t n = 0; n < typed.size(); ++n) {
            const bool is_rest = n + 1 == typed.size() && is_last_repeated(command);
            cases += " \\\n                        " + zsh_quoted((is_rest ? "*" : std::to_string(n + 1)) + ":" +
                                                                  typed[n].name + ":" + zsh_action(typed[n].value));
        }
        cases += "\n                    ;;\n";
    }
    return "#compdef kerf\n# Completes the command line of kerf in zsh. `kerf completion zsh` prints this.\n\n"
           "_kerf() {\n    local context state state_descr line\n    typeset -A opt_args\n    local -a commands\n"
           "    commands=(\n" +
           commands + "    )\n    _arguments -C '(- *)'{-h,--help}'[" + help_summary + "]' '(- *)--version[" +
           version_summary +
           "]' \\\n        '1:command:->command' '*::argument:->argument' && return\n"
           "    case $state in\n        command) _describe -t commands command commands ;;\n"
           "        argument)\n            case $words[1] in\n" +
           cases +
           "            esac\n            ;;\n    esac\n}\n\n"
           "if [[ ${funcstack[1]} == _kerf ]]; then _kerf \"$@\"; else compdef _kerf kerf; fi\n";
}

// ---- fish --------------------------------------------------------------------------------------------------------

std::string fish_quoted(const std::string& text) { return "'" + escaped(text, "\\'") + "'"; }

bool takes_any_file(const Value& value) { return value.kind == ValueKind::file && value.suffix.empty(); }

/// Returns the arguments of `complete` that offer values.
std::string fish_value(const Value& value) {
    switch (value.kind) {
        case ValueKind::words:
            return " -a " + fish_quoted(joined(value.words));
        case ValueKind::number: {
            std::vector<std::string> numbers;
            for (int n = value.min; n <= value.max; ++n) numbers.push_back(std::to_string(n));
            return " -a " + fish_quoted(joined(numbers));
        }
        case ValueKind::file:
            return takes_any_file(value) ? " -F"
                                         : " -a " + fish_quoted("(__fish_complete_suffix " + value.suffix + ")");
        case ValueKind::folder:
            return " -a '(__fish_complete_directories)'";
        default:
            return "";
    }
}

std::string fish_script() {
    std::string text =
        "# Completes the command line of kerf in fish. `kerf completion fish` prints this.\n\ncomplete -c kerf -f\n"
        "complete -c kerf -s h -l help -d " +
        fish_quoted(help_summary) + "\ncomplete -c kerf -n __fish_use_subcommand -l version -d " +
        fish_quoted(version_summary) + "\n";
    for (const Command& command : command_table()) {
        text += "\ncomplete -c kerf -n __fish_use_subcommand -a " + command.name + " -d " +
                fish_quoted(command.summary) + "\n";
        const std::string line = "complete -c kerf -n '__fish_seen_subcommand_from " + command.name + "'";
        for (const Parameter& option : command.options) {
            text += line + " -l " + option.name.substr(2);
            if (!option.short_name.empty()) text += " -s " + option.short_name.substr(1);
            if (!option.is_flag()) text += (takes_any_file(option.value) ? " -r" : " -x") + fish_value(option.value);
            text += " -d " + fish_quoted(help_text(option)) + "\n";
        }
        for (const Parameter& argument : command.arguments)
            if (const std::string value = fish_value(argument.value); !value.empty()) text += line + value + "\n";
    }
    return text;
}

}  // namespace

std::string completion_script(const std::string& shell) {
    return shell == "zsh" ? zsh_script() : shell == "fish" ? fish_script() : bash_script();
}

}  // namespace kerf::app
