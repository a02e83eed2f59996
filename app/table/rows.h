// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/command_table.h"

/// The rows of the table of commands, one function a group of the help.
namespace kerf::app::table {

[[nodiscard]] std::vector<Command> procedure_commands();
[[nodiscard]] std::vector<Command> bone_commands();
[[nodiscard]] std::vector<Command> session_commands();
[[nodiscard]] std::vector<Command> plugin_commands();
[[nodiscard]] std::vector<Command> device_commands();
[[nodiscard]] std::vector<Command> study_commands();
[[nodiscard]] std::vector<Command> program_commands();

}  // namespace kerf::app::table
