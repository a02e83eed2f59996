// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/exit_code.h"
#include "app/installation.h"
#include "app/options.h"

/// The commands of `kerf`, as one table. The parser, the help, the shell completion and the man page come from it.
namespace kerf::app {

/// A value is checked and completed by its kind.
enum class ValueKind {
    none,     ///< a flag has no value
    text,     ///< not empty
    any,      ///< unchecked
    file,     ///< a file name, not empty
    folder,   ///< a folder name, not empty
    words,    ///< one of a few words
    number,   ///< a whole number from min to max
    code,     ///< letters, digits, `.`, `_`, `-`; at most 64
    setting,  ///< path=value
};

struct Value {
    std::string placeholder{};  ///< in help: "FOLDER"
    ValueKind kind = ValueKind::none;
    std::string expects{};             ///< in a message: "a folder, as in `--out out/first`"
    std::vector<std::string> words{};  ///< of ValueKind::words
    std::string suffix{};              ///< completion offers files with this ending: ".yaml"; empty: all
    bool may_be_shipped = false;       ///< the name may be that of a shipped document
    int min = 0, max = 0;              ///< of ValueKind::number
};

/// The member of an options struct that a parameter fills.
using Member = std::variant<std::string*, std::vector<std::string>*, bool*, int*>;

/// An option, or an argument.
struct Parameter {
    std::string name{};        ///< of an option "--out"; of an argument "PROCEDURE"
    std::string short_name{};  ///< "-o"; empty: none
    Value value{};
    std::string help{};
    std::string default_value{};  ///< for people; empty: none
    std::string note{};           ///< a sentence behind the default
    bool is_required = false;
    std::function<Member(Options&)> member{};  ///< returns the member in the options of this command

    [[nodiscard]] bool is_option() const { return name.starts_with('-'); }
    [[nodiscard]] bool is_flag() const { return value.kind == ValueKind::none; }
};

struct Example {
    std::string line{};  ///< "kerf run pedicle-screw.yaml"
    std::string what{};  ///< "runs a shipped procedure"
};

/// How a command was started.
struct Invocation {
    const Installation& here;
    int argc;
    char** argv;
};

struct Command {
    std::string name{};   ///< one word: "run"
    std::string group{};  ///< heading in the help
    std::string summary{};
    std::vector<Parameter> arguments{};
    std::vector<Parameter> options{};
    std::string when_missing{};  ///< message if a required parameter is missing
    std::vector<Example> examples{};
    std::string footer{};  ///< behind the options: files, exit codes; without a line end
    Options defaults{};    ///< an options struct of this command
    std::function<ExitCode(const Options&, const Invocation&)> run{};

    [[nodiscard]] bool has_many(const Parameter& parameter) const;  ///< whether the parameter takes several values
};

/// Returns all commands, in the order of the help.   [any]
[[nodiscard]] const std::vector<Command>& command_table();

/// Returns the command of this name; null if there is none.   [any]
[[nodiscard]] const Command* find_command(std::string_view name);

/// Returns the help of a parameter with its default.   [any] pure.
[[nodiscard]] std::string help_text(const Parameter& parameter);

/// Lines that the general help, the completion and the man page share.
inline constexpr const char* program_summary = "Kerf: haptic simulation of bone surgery.";
inline constexpr const char* help_summary = "Print this help";
inline constexpr const char* version_summary = "Print the version";

}  // namespace kerf::app
