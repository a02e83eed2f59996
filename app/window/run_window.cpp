// SPDX-License-Identifier: Apache-2.0
#include "app/window/run_window.h"

#include <malloc.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

#include "app/window/waiting_screen.h"

namespace kerf::window {

namespace {

constexpr double shortest_frame = 1.0 / 60.0;  // [s]

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void draw_until_closed(GlfwWindow& window, run::ViewedRun& run, const WindowRequest& request) {
    RunScreen screen(run);
    if (request.begins_at) {
        screen.timeline().show_at(*request.begins_at);
        screen.timeline().play(true);
    }
    if (request.is_inspecting) screen.inspect(all_layers);
    screen.set_buttons({request.has_again, request.has_debrief, request.has_resume, request.has_start_page});
    screen.take(window.pointer());  // GLFW reports the cursor only when it moves
    bool has_stopped = false;
    while (true) {
        const double begun = seconds_now();
        for (const Input& input : window.poll()) screen.take(input);
        window.capture_cursor(screen.captures_cursor());
        const bool is_over = screen.is_over();
        if (window.should_close() && !std::exchange(has_stopped, true)) {
            run.stop();
            const bool is_replay = run.duration().has_value();
            if (!is_replay && !is_over && !request.closes_at_end) window.keep_open();
        }
        const auto action = screen.take_action();
        if (action && request.on_leave) request.on_leave(*action);
        if (action || (is_over && window.should_close()) || run.is_closed()) return;
        screen.draw(window.width(), window.height(), begun);
        const bool is_last = is_over && request.closes_at_end;
        if ((screen.takes_picture() || is_last) && request.on_picture) {
            glFinish();
            request.on_picture(screen.pixels(), screen.state().time, is_last);
        }
        window.swap();
        if (is_last) return;
        const double rest = shortest_frame - (seconds_now() - begun);
        if (rest > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(rest));
    }
}

/// Waits until the run has reached a time, or its end, and its radiographs up to then are made.
void wait_for(RunScreen& screen, run::ViewedRun& run, double time) {
    while (!run.is_closed()) {
        screen.timeline().take(run, 0.0);
        if (screen.timeline().newest() >= time || screen.is_over()) {
            screen.timeline().take(run, 0.0);
            screen.timeline().show_at(time);
            if (screen.timeline().has_radiograph()) return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace

void prepare_process() {
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    setenv("LP_NUM_THREADS", "0", 0);  // the software renderer then starts no threads
}

bool show_waiting(GlfwWindow& window, const std::string& what, const std::function<double()>& fraction,
                  const std::function<bool()>& is_done) {
    WaitingScreen screen;
    while (!is_done()) {
        static_cast<void>(window.poll());
        screen.draw(window.width(), window.height(), what, fraction());
        window.swap();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return !window.should_close();
}

std::string show_run(GlfwWindow& window, run::ViewedRun& run, const WindowRequest& request) {
    constexpr int niceness = 10;
    setpriority(PRIO_PROCESS, 0, niceness);  // of this thread
    try {
        draw_until_closed(window, run, request);
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
    return {};
}

std::string draw_run(run::ViewedRun& run, const std::function<std::optional<double>()>& next_time,
                     const std::function<void(const Pixels&, double)>& on_picture, bool is_inspecting) {
    constexpr int width = 1280, height = 800;
    try {
        RunScreen screen(run);
        if (is_inspecting) screen.inspect(all_layers);
        while (const auto time = next_time()) {
            wait_for(screen, run, *time);
            if (run.is_closed()) return {};
            screen.timeline().show_at(*time);
            screen.draw(width, height, *time);
            on_picture(screen.pixels(), *time);
            if (screen.is_over() && *time > screen.timeline().newest()) return {};
        }
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
    return {};
}

}  // namespace kerf::window
