// SPDX-License-Identifier: Apache-2.0
#include "run/signal_table.h"

#include <cstdint>
#include <string>
#include <string_view>

#include "text/quantity.h"

namespace kerf::run {

SignalTable::SignalTable(const std::vector<Tool>& tools) {
    for (std::size_t t = 0; t < tools.size(); ++t) {
        const kerf_component* force = tools[t].setup.force;
        std::size_t same = 0;
        while (tools[same].setup.force != force) ++same;
        first.push_back(same < t ? first[same] : columns.size());
        for (std::uint32_t i = 0; same == t && i < force->force->signal_count; ++i) {
            const kerf_signal& s = force->force->signals[i];
            const std::string unit = s.display_unit;
            columns.push_back({s.id, s.help, unit, parse_unit(unit).value_or(Unit{}).factor});
        }
    }
    if (columns.size() > session::max_signal_columns) columns.resize(session::max_signal_columns);
}

void SignalTable::fill(const Simulation& simulation, session::TickRow& row) const {
    const kerf_force& force = *simulation.setup().force->force;
    for (std::uint32_t i = 0; i < force.signal_count; ++i) {
        const std::size_t column = first[simulation.tool()] + i;
        if (column < columns.size()) row.signals[column] = simulation.signals()[i];
        if (std::string_view(force.signals[i].id) == "drive_power") row.power_drive = simulation.signals()[i];
    }
}

}  // namespace kerf::run
