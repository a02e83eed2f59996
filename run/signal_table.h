// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "session/recorder.h"

namespace kerf {

/// The signals of all tools side by side; tools with the same law share theirs.
struct SignalTable {
    std::vector<SignalColumn> columns;  ///< at most `most_signal_columns`
    std::vector<std::size_t> first;     ///< of each tool

    explicit SignalTable(const std::vector<Tool>& tools);
    /// Those of the tool in hand; the others are 0.
    void fill(const Simulation& simulation, TickRow& row) const;
};

}  // namespace kerf
