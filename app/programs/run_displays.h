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
        std::shared_ptr<window::GlfwWindow> window{};  ///< that shows the start page before and after; null: a new one
    };
    explicit WindowDisplay(Options options) : options_(std::move(options)), window_(options_.window) {}

    [[nodiscard]] std::string open(const std::string& title) override;
    bool wait(const std::string& what, const std::function<double()>& fraction,
              const std::function<bool()>& is_done) override;
    [[nodiscard]] bool wants_end() const override { return window_ != nullptr && window_->should_close(); }
    [[nodiscard]] std::string show(run::ViewedRun& run) override;

private:
    Options options_;
    std::shared_ptr<window::GlfwWindow> window_;
};

/// Pictures in files, drawn without a display.
class PictureDisplay final : public RunDisplay {
public:
    /// Writes one picture, of this time [s].
    static std::unique_ptr<PictureDisplay> one(std::string file, double time);
    /// Writes a picture for every 40 ms from this time on: frame-00000.png …
    static std::unique_ptr<PictureDisplay> film(std::string folder, double from);

    [[nodiscard]] std::string open(const std::string& title) override;
    bool wait(const std::string& what, const std::function<double()>& fraction,
              const std::function<bool()>& is_done) override;
    [[nodiscard]] std::string show(run::ViewedRun& run) override;

private:
    PictureDisplay(std::string path, bool is_film, double from)
        : path_(std::move(path)), is_film_(is_film), from_(from) {}

    std::string path_;
    bool is_film_;
    double from_;  ///< [s]
    std::unique_ptr<window::Offscreen> offscreen_;
};

}  // namespace kerf::app
