// SPDX-License-Identifier: Apache-2.0
#include "app/programs/run_displays.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <thread>

#include "app/outputs.h"
#include "app/preview/png.h"
#include "app/progress.h"
#include "app/standard_streams.h"
#include "text/system_reason.h"
#include "text/write_file.h"

namespace kerf::app {

std::string write_picture(const std::string& file, const window::Pixels& pixels) {
    Picture picture(pixels.width, pixels.height);
    picture.rgb = pixels.rgb;
    std::error_code ignored;
    if (const auto folder = std::filesystem::path(file).parent_path(); !folder.empty())
        std::filesystem::create_directories(folder, ignored);  // write_file reports a folder that is missing
    return text::write_file(file, png_of(picture));
}

// ---- a window -----------------------------------------------------------------------------------------------------

std::string WindowDisplay::open(const std::string& title) {
    std::string error;
    if (window_ != nullptr)
        window_->set_title("Kerf: " + title);
    else
        window_ = window::GlfwWindow::open("Kerf: " + title, error);
    return error.empty() ? error : text::with_memory_limit(error);
}

bool WindowDisplay::wait(const std::string& what, const std::function<double()>& fraction,
                         const std::function<bool()>& is_done) {
    return window::show_waiting(*window_, what, fraction, is_done);
}

std::string WindowDisplay::show(run::ViewedRun& run) {
    const auto save = [&](const window::Pixels& pixels, double time, bool is_last) {
        const std::string file = is_last && !options_.screenshot.empty()
                                     ? options_.screenshot
                                     : options_.folder + formatted("/window-%07.3f-s.png", time);
        const std::string error = write_picture(file, pixels);
        print_error("kerf: " + (error.empty() ? "picture written to " + file : error) + "\n");
    };
    const auto leave = [&](const window::CardAction& action) {
        const auto result = run.result();
        after_ = {action, result ? result->folder : ""};
    };
    const std::string why_not = window::show_run(*window_, run,
                                                 {.on_picture = save,
                                                  .begins_at = options_.begins_at,
                                                  .closes_at_end = !options_.screenshot.empty(),
                                                  .is_inspecting = options_.is_inspecting,
                                                  .has_start_page = options_.has_start_page,
                                                  .has_again = options_.has_again,
                                                  .has_debrief = options_.has_debrief,
                                                  .has_resume = options_.has_resume,
                                                  .on_leave = leave});
    return why_not.empty() ? why_not : "the window cannot draw: " + why_not;
}

// ---- pictures -----------------------------------------------------------------------------------------------------

std::unique_ptr<PictureDisplay> PictureDisplay::one(std::string file, double time, bool is_inspecting) {
    return std::unique_ptr<PictureDisplay>(new PictureDisplay(std::move(file), false, time, is_inspecting));
}

std::unique_ptr<PictureDisplay> PictureDisplay::film(std::string folder, double from, bool is_inspecting) {
    return std::unique_ptr<PictureDisplay>(new PictureDisplay(std::move(folder), true, from, is_inspecting));
}

std::string PictureDisplay::open(const std::string& /*title*/) {
    std::string error;
    offscreen_ = window::Offscreen::open(picture_width, picture_height, error);
    return error.empty() ? error : text::with_memory_limit(error);
}

bool PictureDisplay::wait(const std::string& /*what*/, const std::function<double()>& /*fraction*/,
                          const std::function<bool()>& is_done) {
    while (!is_done()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return true;
}

std::string PictureDisplay::show(run::ViewedRun& run) {
    constexpr double frame = 40e-3;  // [s]
    std::size_t count = 0;
    std::string error;
    const auto next_time = [&]() -> std::optional<double> {
        if (!error.empty() || (!is_film_ && count > 0)) return std::nullopt;
        return from_ + frame * static_cast<double>(count);
    };
    const auto save = [&](const window::Pixels& pixels, double time) {
        const std::string file = is_film_ ? path_ + formatted("/frame-%05zu.png", count) : path_;
        error = write_picture(file, pixels);
        ++count;
        if (is_film_ && run.duration()) show_progress(time / *run.duration(), "drawing frames");
    };
    const std::string why_not = window::draw_run(run, next_time, save, is_inspecting_);
    return why_not.empty() ? error : why_not;
}

}  // namespace kerf::app
