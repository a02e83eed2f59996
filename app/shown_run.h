// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/interruption.h"
#include "app/progress.h"
#include "run/run_observer.h"

namespace kerf::app {

/// Shows the progress of a run, and ends the run at the first Ctrl-C.
class ShownRun final : public run::RunObserver {
public:
    explicit ShownRun(const Interruption& interruption) : interruption_(interruption) {}
    void on_progress(double fraction, const std::string& what) override { show_progress(fraction, what); }
    std::optional<run::RunEnd> end() override {
        return interruption_.has_come() ? std::optional(run::RunEnd::interrupted) : std::nullopt;
    }

private:
    const Interruption& interruption_;
};

}  // namespace kerf::app
