// SPDX-License-Identifier: Apache-2.0
// The window next to an operation on the clock: frame time, and what drawing costs the haptic thread. For training and
// research; not for diagnosis, planning or deciding treatment.
//
//     ./dev bench window                          the amputation, 60 s
//     ./dev bench window PROCEDURE [SECONDS]      a shipped procedure by name
//
//     frame       1280 × 800 with all panels, without a display; processor time of the window's thread [ms]
//     compute     processor time of the haptic thread in each tick [us], in turns of one second of the same run: with
//                 the window drawing, and without
//     view        wall time that the thread of the run needs for the viewer, in each tick [us]
//     jump        the picture of another time on the time line, drawn [ms]
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/window/offscreen.h"
#include "app/window/run_screen.h"
#include "app/window/run_window.h"
#include "core/plugin/loader.h"
#include "run/clock/realtime_thread.h"
#include "run/clock/wall_clock.h"
#include "run/live_run.h"
#include "run/view/run_view.h"

namespace {

using namespace kerf;

double seconds_of(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Spread {
    std::vector<double> values;

    double at(double fraction) {
        if (values.empty()) return 0.0;
        const auto n = static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n), values.end());
        return values[n];
    }
};

/// The wall clock, which keeps the processor time of each tick by whether the window draws.
class TurnClock final : public run::TickClock {
public:
    explicit TurnClock(std::size_t ticks) {
        for (Spread& turn : compute) turn.values.reserve(ticks);
    }
    std::uint32_t wait() noexcept override {
        if (!has_begun_) {
            priority_refused = run::take_fifo_priority(run::haptic_priority);
            has_begun_ = true;
        }
        const std::uint32_t missed = clock_.wait();
        begun_ = seconds_of(CLOCK_THREAD_CPUTIME_ID);
        return missed;
    }
    void tick_done() noexcept override {
        Spread& turn = compute[is_drawing ? 1 : 0];
        if (turn.values.size() < turn.values.capacity())
            turn.values.push_back(seconds_of(CLOCK_THREAD_CPUTIME_ID) - begun_);
        clock_.tick_done();
    }
    std::atomic<bool> is_drawing{false};
    Spread compute[2];
    int priority_refused = 0;

private:
    run::WallClock clock_{Simulation::dt};
    bool has_begun_ = false;
    double begun_ = 0.0;
};

/// Measures what a view costs the thread of the run.
class TimedView final : public run::RunObserver {
public:
    explicit TimedView(run::RunView& view) : view_(&view) { cost.values.reserve(1 << 20); }
    void on_begin(run::Run& run) override {
        const double from = seconds_of(CLOCK_MONOTONIC);
        view_->on_begin(run);
        first = seconds_of(CLOCK_MONOTONIC) - from;
    }
    void on_event(const session::EventRow& event) override { view_->on_event(event); }
    void on_tick(const session::TickRow& row) override {
        const double from = seconds_of(CLOCK_MONOTONIC);
        view_->on_tick(row);
        cost.values.push_back(seconds_of(CLOCK_MONOTONIC) - from);
    }
    std::optional<run::RunEnd> end() override { return view_->end(); }
    std::string on_result(const session::RunSummary& summary, const Simulation& simulation) override {
        return view_->on_result(summary, simulation);
    }
    Spread cost;
    double first = 0.0;  ///< [s] of the first surface

private:
    run::RunView* view_;
};

void print(const char* what, Spread& spread, double unit) {
    std::printf("%-26s %8zu  %8.2f %8.2f %8.2f\n", what, spread.values.size(), spread.at(0.5) / unit,
                spread.at(0.999) / unit, spread.at(1.0) / unit);
}

}  // namespace

int main(int argc, char** argv) {
    window::prepare_process();
    setenv("LP_NUM_THREADS", "1", 1);
    const std::string name = argc > 1 ? argv[1] : "amputation";
    const double seconds = argc > 2 ? std::atof(argv[2]) : 60.0;
    PluginRegistry plugins;
    plugins.scan({KERF_BUILD_DIR "/lib/kerf"});
    text::Diagnostics diagnostics;
    const auto scene = run::make_scene(KERF_SOURCE_DIR "/procedures/" + name + ".yaml", "", plugins).take(diagnostics);
    if (!scene) {
        std::printf("%s", to_text(diagnostics).c_str());
        return 2;
    }
    const double made = seconds_of(CLOCK_MONOTONIC);
    run::RunView view(*scene, {.mode = "practice", .hand = "rehearsal"});
    TimedView timed(view);
    run::RunRequest request;
    request.observers = {&timed};
    TurnClock clock(static_cast<std::size_t>(1100.0 * seconds));
    std::thread running([&] { static_cast<void>(run::run_beside_clock(*scene, plugins, request, clock)); });

    setpriority(PRIO_PROCESS, 0, 10);
    std::string error;
    const auto offscreen = window::Offscreen::open(1280, 800, error);
    if (offscreen == nullptr) {
        std::printf("%s\n", error.c_str());
        std::exit(3);
    }
    Spread frames, wall_frames, jumps;
    double first_picture = 0.0;
    {
        window::RunScreen screen(view);
        for (;;) {
            const double now = seconds_of(CLOCK_MONOTONIC);
            if (screen.is_over() || now - made > seconds) break;
            const bool draws = static_cast<int>(now - made) % 2 == 0;
            clock.is_drawing = draws;
            if (!draws) {
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
                continue;
            }
            const double from = seconds_of(CLOCK_THREAD_CPUTIME_ID);
            screen.draw(1280, 800, now);
            glFinish();
            if (!screen.has_surface()) continue;
            frames.values.push_back(seconds_of(CLOCK_THREAD_CPUTIME_ID) - from);
            wall_frames.values.push_back(seconds_of(CLOCK_MONOTONIC) - now);
            if (first_picture == 0.0) first_picture = seconds_of(CLOCK_MONOTONIC) - made;
            const double rest = 1.0 / 60.0 - wall_frames.values.back();
            if (rest > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(rest));
        }
        view.stop();
        running.join();
        for (int i = 0; i < 40; ++i) {
            const double from = seconds_of(CLOCK_MONOTONIC);
            screen.timeline().show_at(std::fmod(0.37 * i, 1.0) * screen.timeline().newest());
            screen.draw(1280, 800, from);
            glFinish();
            jumps.values.push_back(seconds_of(CLOCK_MONOTONIC) - from);
        }
        std::printf("%s, %s\n", name.c_str(), window::renderer_name().c_str());
        std::printf("first surface after %.2f s, first picture %.2f s after the body was made\n", timed.first,
                    first_picture);
        if (clock.priority_refused != 0) std::printf("the haptic thread has no real-time priority\n");
    }
    std::printf("\n%-26s %8s  %8s %8s %8s\n", "", "number", "median", "p99.9", "worst");
    print("frame, thread [ms]", frames, 1e-3);
    print("frame, wall [ms]", wall_frames, 1e-3);
    print("jump, wall [ms]", jumps, 1e-3);
    print("view, run's thread [us]", timed.cost, 1e-6);
    print("compute, not drawing [us]", clock.compute[0], 1e-6);
    print("compute, drawing [us]", clock.compute[1], 1e-6);
    std::printf("\ncompute p99.9 drawing : not drawing = %.2f\n",
                clock.compute[1].at(0.999) / clock.compute[0].at(0.999));
    return 0;
}
