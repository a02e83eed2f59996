// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

std::vector<Command> program_commands() {
    std::vector<Command> rows;
    rows.push_back({.name = "completion",
                    .group = "Program",
                    .summary = "Print a script that completes commands, options and files in a shell",
                    .arguments = {{.name = "SHELL",
                                   .value = one_of("", {"bash", "zsh", "fish"}),
                                   .help = "bash, zsh or fish",
                                   .is_required = true,
                                   .member = in<CompletionOptions>(&CompletionOptions::shell)}},
                    .when_missing = "for which shell? Write `kerf completion bash`.",
                    .examples = {{"kerf completion bash", "prints the script for bash"}},
                    .footer = "For this shell alone: source <(kerf completion bash)",
                    .defaults = CompletionOptions{},
                    .run = alone(&commands::print_completion)});
    rows.push_back({.name = "man",
                    .group = "Program",
                    .summary = "Print the manual page kerf(1) as roff",
                    .examples = {{"kerf man", "prints the page; `kerf man | man -l -` shows it"}},
                    .defaults = ManOptions{},
                    .run = alone(&commands::print_man_page)});
    return rows;
}

}  // namespace kerf::app::table
