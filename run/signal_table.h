// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "session/recorder.h"

namespace kerf::run {

/// The signals of all tools in one table. Tools with the same law use the same columns.
struct SignalTable {
    std::vector<session::SignalColumn> columns;  ///< at most `max_signal_columns`
    std::vector<std::size_t> first;              ///< for each tool: its first column

    explicit SignalTable(const std::vector<Tool>& tools);
    /// Sets the signals of the present tool; the others are 0.
    void fill(const Simulation& simulation, session::TickRow& row) const;
};

}  // namespace kerf::run
