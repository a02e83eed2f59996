// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/run_display.h"
#include "app/window/offscreen.h"
#include "app/window/run_window.h"

namespace kerf::app {

/// Size of the pictures that are drawn without a display, in pixels.
inline constexpr int picture_width = 1280, picture_height = 800;

/// Writes a picture, without text or time in its file, and makes its folder. Returns the error as text, empty on
/// success.   [main]
[[nodiscard]] std::string write_picture(const std::string& file, const window::Pixels& pixels);

/// A window of the desktop.
class WindowDisplay final : public RunDisplay {
public:
    struct Options {
        std::string folder{};               ///< for pictures that the user takes
        std::string screenshot{};           ///< file of a picture after the result, with which it closes; empty: none
        std::optional<double> begins_at{};  ///< [s] nothing: it shows the newest state
        bool is_inspecting = false;         ///< shows all layers of the law's inspection
        std::shared_ptr<window::GlfwWindow> window{};                     ///< that shows this run; null: a new one
        bool has_start_page = false;                                      ///< before and after the run
        bool has_again = false, has_debrief = false, has_resume = false;  ///< buttons of the card with the result
    };
    /// What the user wants after a run.
    struct After {
        window::CardAction action{};
        std::string folder{};  ///< of the results of the run
    };
    explicit WindowDisplay(Options options) : options_(std::move(options)), window_(options_.window) {}

    [[nodiscard]] std::string open(const std::string& title) override;
    bool wait(const std::string& what, const std::function<double()>& fraction,
              const std::function<bool()>& is_done) override;
    [[nodiscard]] bool wants_end() const override { return window_ != nullptr && window_->should_close(); }
    [[nodiscard]] std::string show(run::ViewedRun& run) override;
    [[nodiscard]] const After& after() const noexcept { return after_; }
    [[nodiscard]] const std::shared_ptr<window::GlfwWindow>& window() const noexcept { return window_; }

private:
    Options options_;
    std::shared_ptr<window::GlfwWindow> window_;
    After after_;
};

/// Pictures in files, drawn without a display.
class PictureDisplay final : public RunDisplay {
public:
    /// Writes one picture, of this time [s].
    static std::unique_ptr<PictureDisplay> one(std::string file, double time, bool is_inspecting);
    /// Writes a picture for every 40 ms from this time on: frame-00000.png …
    static std::unique_ptr<PictureDisplay> film(std::string folder, double from, bool is_inspecting);

    [[nodiscard]] std::string open(const std::string& title) override;
    bool wait(const std::string& what, const std::function<double()>& fraction,
              const std::function<bool()>& is_done) override;
    [[nodiscard]] std::string show(run::ViewedRun& run) override;

private:
    PictureDisplay(std::string path, bool is_film, double from, bool is_inspecting)
        : path_(std::move(path)), is_film_(is_film), from_(from), is_inspecting_(is_inspecting) {}

    std::string path_;
    bool is_film_;
    double from_;  ///< [s]
    bool is_inspecting_;
    std::unique_ptr<window::Offscreen> offscreen_;
};

}  // namespace kerf::app
