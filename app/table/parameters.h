// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/command_table.h"
#include "app/commands.h"
#include "app/program.h"

/// Values, parameters and functions that several rows of the table of commands share.
namespace kerf::app::table {

// ---- values ------------------------------------------------------------------------------------------------------

inline Value yaml(const std::string& placeholder = "FILE") {
    return {.placeholder = placeholder,
            .kind = ValueKind::file,
            .expects = "the name of a YAML file",
            .suffix = ".yaml",
            .may_be_shipped = true};
}
inline Value file(const std::string& expects, const std::string& suffix = "", const std::string& placeholder = "FILE") {
    return {.placeholder = placeholder, .kind = ValueKind::file, .expects = expects, .suffix = suffix};
}
inline Value folder() {
    return {.placeholder = "FOLDER", .kind = ValueKind::folder, .expects = "a folder, as in `--out out/first`"};
}
inline Value text(const std::string& placeholder, const std::string& expects) {
    return {.placeholder = placeholder, .kind = ValueKind::text, .expects = expects};
}
inline Value one_of(const std::string& placeholder, std::vector<std::string> words) {
    return {.placeholder = placeholder, .kind = ValueKind::words, .words = std::move(words)};
}

// ---- parameters --------------------------------------------------------------------------------------------------

/// Returns how to find a member in the options struct T.
template <class T, class Type, class Base>
std::function<Member(Options&)> in(Type Base::*member) {
    return [member](Options& options) -> Member { return &(std::get<T>(options).*member); };
}

template <class T>
Parameter procedure_of() {
    return {.name = "PROCEDURE",
            .value = yaml(),
            .help = "YAML file of the procedure",
            .is_required = true,
            .member = in<T>(&T::procedure)};
}
template <class T>
Parameter procedures_of() {
    return {.name = "PROCEDURE",
            .value = yaml(),
            .help = "YAML files of procedures, one or more",
            .is_required = true,
            .member = in<T>(&T::procedures)};
}
template <class T>
Parameter anatomy_of(const std::string& procedure = "procedure's") {
    return {.name = "--anatomy",
            .value = yaml(),
            .help = "Use this anatomy in place of the " + procedure + " own",
            .member = in<T>(&T::anatomy)};
}
template <class T>
Parameter language_of() {
    return {.name = "--language",
            .value = text("LANGUAGE", "a language, as in `--language de`"),
            .help = "Language of the procedure's words in the window",
            .default_value = "that of the environment",
            .note = "The program's own words are English",
            .member = in<T>(&T::language)};
}
template <class T>
Parameter variant_of() {
    return {.name = "--variant",
            .value = text("VARIANT", "the id of a variant"),
            .help = "Apply one of the procedure's `variants:`",
            .member = in<T>(&T::variant)};
}
template <class T>
Parameter patches_of(const std::string& help = "Apply the changes in this file; may be repeated") {
    return {.name = "--patch", .value = yaml(), .help = help, .member = in<T>(&T::patches)};
}
template <class T>
Parameter settings_of(
    const std::string& help = "Change a value, as in `--set accuracy.spacing=0.5 mm`; may be repeated") {
    return {.name = "--set",
            .value = {.placeholder = "PATH=VALUE", .kind = ValueKind::setting},
            .help = help,
            .member = in<T>(&T::settings)};
}
template <class T>
Parameter out_of(const Value& value, const std::string& help, const std::string& default_value = "",
                 const std::string& note = "") {
    return {.name = "--out",
            .short_name = "-o",
            .value = value,
            .help = help,
            .default_value = default_value,
            .note = note,
            .member = in<T>(&T::out)};
}
template <class T>
Parameter format_of(std::vector<std::string> words, const std::string& help) {
    return {.name = "--format",
            .value = one_of("FORMAT", std::move(words)),
            .help = help,
            .default_value = "text",
            .member = in<T>(&T::format)};
}
inline Parameter flag(const std::string& name, const std::string& help, std::function<Member(Options&)> member) {
    return {.name = name, .help = help, .member = std::move(member)};
}

// ---- functions that run ------------------------------------------------------------------------------------------

using RunFunction = std::function<ExitCode(const Options&, const Invocation&)>;

/// Loads the plugins, then runs.
template <class T>
RunFunction with_environment(ExitCode (*function)(const T&, const Environment&)) {
    return [function](const Options& options, const Invocation& call) {
        return with_plugins(call.here, [&](const PluginRegistry& plugins) {
            return function(std::get<T>(options), {plugins, call.here});
        });
    };
}

/// Runs without plugins.
template <class T>
RunFunction alone(ExitCode (*function)(const T&)) {
    return [function](const Options& options, const Invocation&) { return function(std::get<T>(options)); };
}

/// Starts libexec/kerf/kerf-NAME. The conformance kit and the studies are such programs: an operation never needs them.
inline RunFunction own_program(const std::string& name) {
    return [name](const Options&, const Invocation& call) { return become_program_of(name, call.here, call.argv); };
}

}  // namespace kerf::app::table
