// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/interruption.h"
#include "app/progress.h"
#include "run/run_observer.h"

namespace kerf::app {

/// Shows the progress of a run and the work after its last tick, and ends the run at the first Ctrl-C.
class ShownRun final : public run::RunObserver {
public:
    explicit ShownRun(const Interruption& interruption) : interruption_(interruption) {}
    void on_progress(double fraction, const std::string& what) override {
        work_.reset();
        if (fraction < 1.0) return show_progress(fraction, what);
        work_.emplace(what);  // what follows the last tick may take minutes
    }
    void end_work() { work_.reset(); }
    std::optional<run::RunEnd> end() override {
        return interruption_.has_come() ? std::optional(run::RunEnd::interrupted) : std::nullopt;
    }

private:
    const Interruption& interruption_;
    std::optional<StillWorking> work_;
};

}  // namespace kerf::app
