// SPDX-License-Identifier: Apache-2.0
#include "app/man_page.h"

#include <cstddef>
#include <cstdio>

#include "app/command_table.h"
#include "session/recorder.h"

namespace kerf::app {

namespace {

/// Appends the character of UTF-8 at `at` as roff names it, and moves `at` behind it. Pre: valid UTF-8.
void append_character(const std::string& text, std::size_t& at, std::string& out) {
    const auto byte = [&](std::size_t n) { return n < text.size() ? static_cast<unsigned char>(text[n]) : 0u; };
    const unsigned first = byte(at);
    const std::size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
    unsigned code = first & (0x3fu >> more);
    for (std::size_t n = 1; n <= more; ++n) code = code << 6 | (byte(at + n) & 0x3fu);
    at += more + 1;
    if (code == 0x2026) {  // an ellipsis, which an ASCII terminal lacks
        out += "...";
        return;
    }
    char name[16];
    std::snprintf(name, sizeof name, "\\[u%04X]", code);
    out += name;
}

/// Text of a paragraph: nothing in it is a request, and what lies between backticks is bold.
std::string roff(const std::string& text) {
    std::string out;
    bool is_bold = false, is_line_start = true;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (static_cast<unsigned char>(c) >= 0x80) {
            append_character(text, at, out);
            is_line_start = false;
            continue;
        }
        ++at;
        if (is_line_start && (c == '.' || c == '\'')) out += "\\&";
        is_line_start = c == '\n';
        if (c == '`')
            out += (is_bold = !is_bold) ? "\\fB" : "\\fR";
        else if (c == '\n')
            out += "\n.br\n";
        else if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if (c == '\'')
            out += "\\(aq";
        else if (c == '~')
            out += "\\(ti";
        else if (c == '^')
            out += "\\(ha";
        else
            out += c;
    }
    return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

/// `-o, --out FOLDER`
std::string head_of(const Parameter& parameter) {
    if (!parameter.is_option()) return italic(parameter.name);
    std::string text = (parameter.short_name.empty() ? "" : bold(parameter.short_name) + ", ") + bold(parameter.name);
    return parameter.is_flag() ? text : text + " " + italic(parameter.value.placeholder);
}

std::string synopsis_of(const Command& command) {
    std::string text = bold("kerf " + command.name);
    if (!command.options.empty()) text += " [" + italic("OPTIONS") + "]";
    for (const Parameter& argument : command.arguments) {
        const std::string name = italic(argument.name) + (command.has_many(argument) ? "..." : "");
        text += " " + (argument.is_required ? name : "[" + name + "]");
    }
    return text;
}

std::string section_of(const Command& command) {
    std::string text =
        ".SS " + bold("kerf " + command.name) + "\n" + synopsis_of(command) + "\n.PP\n" + roff(command.summary) + ".\n";
    for (const auto* parameters : {&command.arguments, &command.options})
        for (const Parameter& parameter : *parameters)
            text += ".TP\n" + head_of(parameter) + "\n" + roff(help_text(parameter)) + ".\n";
    if (!command.footer.empty()) text += ".PP\n" + roff(command.footer) + "\n";
    return text;
}

std::string examples() {
    std::string text;
    for (const Command& command : command_table())
        for (const Example& example : command.examples)
            text += ".TP\n" + bold(example.line) + "\n" + roff(example.what) + ".\n";
    return text;
}

}  // namespace

std::string man_page() {
    const std::string notice = std::string(session::notice_line) + ".";
    std::string commands, sections;
    for (const Command& command : command_table()) {
        commands += ".TP\n" + bold(command.name) + "\n" + roff(command.summary) + ".\n";
        sections += section_of(command);
    }
    return ".\\\" `kerf man` prints this page.\n.TH KERF 1 \"\" \"kerf " KERF_VERSION "\" \"Kerf\"\n"
           ".SH NAME\nkerf \\- haptic simulation of bone surgery\n"
           ".SH SYNOPSIS\n" +
           bold("kerf") + " " + italic("COMMAND") + " [" + italic("OPTIONS") + "] [" + italic("ARGUMENTS") +
           "]\n.SH DESCRIPTION\n"
           "Kerf simulates bone surgery with haptic feedback. A procedure is a YAML file. Kerf runs it, assesses it "
           "and "
           "records it.\n.PP\n" +
           roff(notice) + "\n.SH COMMANDS\n" + commands + ".SH OPTIONS\n.TP\n" + bold("-h") + ", " + bold("--help") +
           "\n" + roff(std::string(help_summary)) + "; with a command, the help of this command.\n.TP\n" +
           bold("--version") + "\n" + roff(version_summary) + ".\n" + sections +
           ".SH EXIT STATUS\n.TP\n.B 0\nPass: the command found nothing wrong.\n.TP\n.B 1\n"
           "Not passed: fail, incomplete or invalid.\n.TP\n.B 2\nBad input.\n.TP\n.B 3\n"
           "The machine or the program failed, or the user interrupted it.\n"
           ".SH ENVIRONMENT\n.TP\n.B KERF_PLUGIN_PATH\n"
           "Folders with plugins, separated by colons. Kerf searches them before its own.\n"
           ".TP\n.B KERF_PLUGIN_ALLOW\nIds that begin with \"kerf.\", separated by colons, which plugins of other "
           "folders "
           "may have in this run.\n"
           ".TP\n.B KERF_BADGES\nFolder with the badges of plugins; \"off\" switches badges and their warning "
           "off.\n"
           ".SH FILES\n.TP\n.I PREFIX/share/kerf/procedures\nShipped procedures and anatomies. A command finds them by "
           "name.\n.TP\n.I PREFIX/lib/kerf\nPlugins.\n.TP\n.I PREFIX/share/doc/kerf\nDocumentation.\n"
           ".SH EXAMPLES\n" +
           examples();
}

}  // namespace kerf::app
