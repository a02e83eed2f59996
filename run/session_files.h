// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "run/run_observer.h"
#include "run/run_procedure.h"
#include "session/output_folder.h"
#include "session/recorder.h"

namespace kerf::run {

/// Writes the files of a run: session.db during the run, then summary.json, report.html and the surfaces of its pieces.
/// It locks the folder until then.   [main]
class SessionFiles final : public RunObserver {
public:
    /// Opens the session in the folder `request.out`. `summary` has the data known before the first tick. Returns null
    /// with the reason in `refusal`; the folder is then unchanged.
    static std::unique_ptr<SessionFiles> create(const Scene& scene, const RunRequest& request,
                                                const session::RunSummary& summary, RunOutcome& refusal);

    void on_event(const session::EventRow& event) override { recorder_->push_event(event); }
    void on_cut(const CutRecord& cut) override;
    void on_tick(const session::TickRow& row) override { recorder_->push(row); }
    /// Waits until the session can take more rows. Returns `unrecorded` if its file cannot be written any more.
    [[nodiscard]] std::optional<RunEnd> end() override;
    [[nodiscard]] std::string on_exact_surface(const bone::ExactSurface& made) override;
    [[nodiscard]] std::string on_result(const session::RunSummary& summary, const Simulation& simulation) override;

    /// Sets a function that gets each activity of `on_result` when it begins.
    void report_work(std::function<void(const std::string& what)> report) { report_work_ = std::move(report); }

private:
    SessionFiles() = default;
    void begin(const std::string& what) const {
        if (report_work_) report_work_(what);
    }

    std::string folder_;
    text::OutputLock lock_;
    text::MadeFolders made_;
    std::unique_ptr<session::Recorder> recorder_;
    std::function<void(const std::string& what)> report_work_;
};

}  // namespace kerf::run
