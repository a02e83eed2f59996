// SPDX-License-Identifier: Apache-2.0
#include "app/command_table.h"

#include <algorithm>
#include <iterator>

#include "app/table/rows.h"

namespace kerf::app {

bool Command::has_many(const Parameter& parameter) const {
    Options any = defaults;
    return std::holds_alternative<std::vector<std::string>*>(parameter.member(any));
}

const std::vector<Command>& command_table() {
    static const std::vector<Command> table = [] {
        std::vector<Command> all;
        using namespace table;
        for (auto group : {&procedure_commands, &bone_commands, &session_commands, &plugin_commands, &device_commands,
                           &study_commands, &program_commands}) {
            std::vector<Command> rows = group();
            std::move(rows.begin(), rows.end(), std::back_inserter(all));
        }
        return all;
    }();
    return table;
}

const Command* find_command(std::string_view name) {
    const auto& table = command_table();
    const auto found = std::find_if(table.begin(), table.end(), [&](const Command& c) { return c.name == name; });
    return found == table.end() ? nullptr : &*found;
}

std::string help_text(const Parameter& parameter) {
    std::string text = parameter.help;
    const bool is_marked = text.find("(default)") != std::string::npos;
    if (!parameter.default_value.empty() && !is_marked) text += "; default: " + parameter.default_value;
    return parameter.note.empty() ? text : text + ". " + parameter.note;
}

}  // namespace kerf::app
