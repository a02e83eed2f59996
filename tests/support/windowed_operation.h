// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <thread>

#include "run/clock/wall_clock.h"
#include "run/live_run.h"
#include "run/view/run_view.h"
#include "tests/support/scripted_mouse.h"
#include "tests/support/window_person.h"

namespace kerf::test {

/// A clock that waits for a frame of the window every 16 ticks, however long that takes.
class FrameClock final : public run::TickClock {
public:
    std::uint32_t wait() noexcept override {
        if (ticks_++ % ticks_per_frame != 0) return 0;
        due_.release();
        done_.acquire();
        return 0;
    }
    /// Waits for the run to need a frame. Returns false if it needed none for a while.   [the window's thread]
    [[nodiscard]] bool is_due() { return due_.try_acquire_for(std::chrono::milliseconds(20)); }
    void frame_done() { done_.release(); }
    [[nodiscard]] double time() const noexcept { return Simulation::dt * static_cast<double>(ticks_); }

private:
    static constexpr std::uint64_t ticks_per_frame = 16;
    std::uint64_t ticks_ = 0;
    std::binary_semaphore due_{0}, done_{0};
};

struct WindowedOperation {
    run::RunOutcome outcome;
    std::size_t legs_done = 0, legs = 0;  ///< of the rehearsal
    std::size_t frames = 0;
};

/// A rehearsal that a person carries out by mouse and keys in a window on a display.
class OperationAtAWindow {
public:
    /// Pre: the arguments outlive this object.
    OperationAtAWindow(const run::Scene& scene, const PluginRegistry& plugins, window::GlfwWindow& window)
        : scene_(&scene), plugins_(&plugins), window_(&window) {}

    /// Called after each frame that was drawn, with the time of the run [s].
    std::function<void(const window::RunScreen&, double)> on_frame;
    /// Draws each of this many frames on the virtual clock; the wall clock draws all.
    std::size_t drawn_each = 16;

    /// Operates on a virtual clock, which waits for the window.
    [[nodiscard]] WindowedOperation on_virtual_clock(const std::string& rehearsal) {
        FrameClock clock;
        return operate(
            rehearsal,
            [&](run::RunRequest& request, run::MouseBox& box) {
                return run::run_on_clock(*scene_, *plugins_, request, clock, box);
            },
            [&](const std::function<void(double)>& frame) {
                if (!clock.is_due()) return;
                frame(clock.time());
                clock.frame_done();
            });
    }
    /// Operates on the wall clock, next to a window that draws as fast as it can.
    [[nodiscard]] WindowedOperation on_wall_clock(const std::string& rehearsal) {
        drawn_each = 1;
        const auto begun = std::chrono::steady_clock::now();
        return operate(
            rehearsal,
            [&](run::RunRequest& request, run::MouseBox& box) {
                return run::run_live(*scene_, *plugins_, request, box);
            },
            [&](const std::function<void(double)>& frame) {
                const auto now = std::chrono::steady_clock::now();
                frame(std::chrono::duration<double>(now - begun).count());
                std::this_thread::sleep_until(now + std::chrono::milliseconds(16));
            });
    }

private:
    template <class RunIt, class Pace>
    WindowedOperation operate(const std::string& rehearsal, const RunIt& run_it, const Pace& pace) {
        run::MouseBox wanted, done;
        ScriptedMouse plan(*scene_, wanted, rehearsal);
        run::RunView view(*scene_, {.mode = "practice", .hand = "mouse"});
        view.let_mouse_lead(done);
        window::RunScreen screen(view);
        WindowPerson person(screen, wanted);
        run::RunRequest request;
        request.rehearsal = rehearsal;
        request.observers = {&plan, &view};

        WindowedOperation result;
        std::exception_ptr fault;
        std::atomic<bool> is_over{false};
        std::thread running([&] {
            try {
                result.outcome = run_it(request, done);
            } catch (...) {
                fault = std::current_exception();
            }
            is_over = true;
        });
        std::exception_ptr fault_of_window;
        try {
            while (!is_over)
                pace([&](double wall) {
                    if (result.frames == 0) person.begin();
                    show_frame(screen, person, wall, result.frames++);
                });
            person.end();
            take_batch(screen);
            window_->capture_cursor(false);
        } catch (...) {
            fault_of_window = std::current_exception();
            view.stop();
            while (!is_over) pace([](double) {});
        }
        running.join();
        if (fault_of_window) std::rethrow_exception(fault_of_window);
        if (fault) std::rethrow_exception(fault);
        result.legs_done = plan.legs_done();
        result.legs = plan.legs();
        return result;
    }
    void show_frame(window::RunScreen& screen, WindowPerson& person, double wall, std::size_t number) {
        if (number > 0) person.act();
        take_batch(screen);
        window_->capture_cursor(screen.captures_cursor());
        if (number % drawn_each != 0) return screen.update(wall);
        screen.draw(window_->width(), window_->height(), wall);
        if (on_frame) on_frame(screen, screen.state().time);
        window_->swap();
    }
    /// Gives the screen what a batch of events has caused.
    void take_batch(window::RunScreen& screen) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        for (bool is_done = false; !is_done;) {
            for (const window::Input& input : window_->poll()) {
                screen.take(input);
                is_done = is_done || DisplayHands::ends_batch(input);
            }
            if (std::chrono::steady_clock::now() > end) throw std::runtime_error("the display gave no event for 5 s");
            if (!is_done) std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    }

    const run::Scene* scene_;
    const PluginRegistry* plugins_;
    window::GlfwWindow* window_;
};

}  // namespace kerf::test
