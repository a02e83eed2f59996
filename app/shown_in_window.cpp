// SPDX-License-Identifier: Apache-2.0
#include "app/shown_in_window.h"

#include <atomic>
#include <exception>
#include <utility>

#include "app/make_bone.h"
#include "app/run_thread.h"

namespace kerf::app {

ExitCode wait_shown(const std::string& what, RunDisplay& display, const Interruption& interruption,
                    const std::function<ExitCode()>& work) {
    return done_behind(
        display, what, [] { return 0.5; }, work,
        [&] {
            if (display.wants_end()) interruption.come();
        });
}

text::Result<run::Scene> make_bone_shown(run::Documents documents, const std::string& file, RunDisplay& display) {
    std::atomic<double> fraction{0.0};
    return done_behind(
        display, "Making the bone", [&] { return fraction.load(); },
        [&] { return make_bone(std::move(documents), file, {}, [&](double done) { fraction = done; }); }, [] {});
}

run::RunOutcome run_behind(RunDisplay& display, run::RunView& view, const Interruption& interruption,
                           const std::function<run::RunOutcome()>& run) {
    auto running = RunThread::of_process().run([&] {
        run::RunOutcome outcome;
        try {
            outcome = run();
        } catch (...) {
            view.close();
            throw;
        }
        if (!outcome.error.empty() || interruption.has_come()) view.close();
        return outcome;
    });
    const std::string why_not = display.show(view);
    view.stop();
    run::RunOutcome outcome = running.get();
    if (!why_not.empty() && outcome.error.empty()) outcome.error = why_not;
    return outcome;
}

run::RunOutcome run_shown(const run::Scene& scene, run::RunRequest request, const std::string& language,
                          run::MouseBox* mouse, const Interruption& interruption, RunDisplay& display,
                          const std::function<run::RunOutcome(const run::RunRequest&)>& run) {
    const std::string hand = mouse != nullptr ? "mouse"
                             : !request.leader.empty()
                                 ? request.leader
                                 : "rehearsal " + run::rehearsal_of(scene.procedure, request.rehearsal).id;
    run::RunView view(scene, {.mode = request.mode,
                              .hand = hand,
                              .folder = request.out,
                              .language = language,
                              .assist = request.assist_with(scene.procedure),
                              .repeated = request.beginning ? request.beginning->duration() : 0.0});
    if (mouse != nullptr) view.let_mouse_lead(*mouse, [&] { return interruption.has_come(); });
    request.observers.push_back(&view);
    return run_behind(display, view, interruption, [&] { return run(request); });
}

}  // namespace kerf::app
