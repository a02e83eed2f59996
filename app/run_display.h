// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "run/view/viewed_run.h"

namespace kerf::app {

/// Shows a run while it runs. The program `kerf` has none; libexec/kerf/kerf-window shows it in a window.   [main]
class RunDisplay {
public:
    virtual ~RunDisplay() = default;

    /// Opens the display. Returns the reason if it cannot; empty on success.
    [[nodiscard]] virtual std::string open(const std::string& title) = 0;
    /// Shows work in progress, until `is_done` returns true. Returns false if the user wants to end it.
    virtual bool wait(const std::string& what, const std::function<double()>& fraction,
                      const std::function<bool()>& is_done) = 0;
    /// Returns whether the user wants to end.   [any]
    [[nodiscard]] virtual bool wants_end() const { return false; }
    /// Shows a run until it has a result and the user closes the display, which also ends a running one. Returns the
    /// reason if it cannot draw; then the run continues.
    [[nodiscard]] virtual std::string show(run::ViewedRun& run) = 0;
};

}  // namespace kerf::app
