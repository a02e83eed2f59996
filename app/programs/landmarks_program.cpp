// SPDX-License-Identifier: Apache-2.0
#include "app/programs/landmarks_program.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/interruption.h"
#include "app/outputs.h"
#include "app/picked_bone.h"
#include "app/programs/run_displays.h"
#include "app/progress.h"
#include "app/shown_in_window.h"
#include "app/standard_streams.h"
#include "app/window/landmark_window.h"
#include "kerf/units.hpp"
#include "text/quantity.h"
#include "text/system_reason.h"

namespace kerf::app {

namespace {

using Made = text::Result<std::unique_ptr<PickedBone>>;

text::QuantityNeed length_need(double min, double max) { return {dimension::length, "mm", min, max}; }

/// Returns the spacing of the options; `error` gets what is wrong with it.
std::optional<double> spacing_of(const LandmarksOptions& options, std::string& error) {
    if (options.spacing.empty()) return std::nullopt;
    const auto parsed = text::parse_quantity(options.spacing, "`--spacing`", length_need(0.05e-3, 5e-3));
    if (!parsed.value) error = parsed.problem.message;
    return parsed.value;
}

/// Returns where a ray "FROM, THROUGH" meets the bone; nothing with the reason in `error`.
std::optional<Vec3> hit_by(std::string_view ray, const std::string& option, const PickedBone& bone,
                           std::string& error) {
    const std::size_t comma = ray.find(',');
    if (comma == std::string_view::npos || ray.find(',', comma + 1) != std::string_view::npos) {
        error = option + " has a ray `" + text::shown(ray) +
                "`. Write two points with a comma between, as in `0 80 0 mm, 0 0 0 mm`.";
        return std::nullopt;
    }
    const auto from = text::parse_vector(ray.substr(0, comma), option, length_need(-2.0, 2.0));
    const auto through = text::parse_vector(ray.substr(comma + 1), option, length_need(-2.0, 2.0));
    if (!from.value || !through.value) {
        error = from.value ? through.problem.message : from.problem.message;
        return std::nullopt;
    }
    if (length(*through.value - *from.value) < 1e-6) {
        error = option + " has a ray whose two points are the same. Write two different points.";
        return std::nullopt;
    }
    const auto point = bone.surface_point(*from.value, normalized(*through.value - *from.value));
    if (!point) error = option + " has a ray that meets no bone. Write another one.";
    return point ? std::optional(point->position) : std::nullopt;
}

/// Adds the landmarks of the options. Returns what is wrong with one; empty on success.
std::string add_all(const LandmarksOptions& options, const PickedBone& bone, window::LandmarkList& list) {
    std::string error;
    const auto add = [&](const std::string& setting, bool is_axis) {
        const std::size_t equals = setting.find('=');
        const std::string name = setting.substr(0, equals), rays = setting.substr(equals + 1);
        const std::string option = (is_axis ? "`--axis " : "`--point ") + text::shown(name) + "`";
        error = list.has(name) ? option + " is given twice. Rename one." : bone.problem_of_name(name);
        if (!error.empty()) return;
        const std::size_t semicolon = rays.find(';');
        if (is_axis != (semicolon != std::string::npos)) {
            error = option + (is_axis ? " has one ray. Write two with a semicolon between."
                                      : " has two rays. Write one, or `--axis`.");
            return;
        }
        const auto at = hit_by(std::string_view(rays).substr(0, semicolon), option, bone, error);
        if (!at) return;
        list.add(name, *at);
        if (!is_axis) return;
        const auto to = hit_by(std::string_view(rays).substr(semicolon + 1), option, bone, error);
        if (!to) return;
        list.add(name, *to);
        list.join(name);
    };
    for (const std::string& point : options.points)
        if (error.empty()) add(point, false);
    for (const std::string& axis : options.axes)
        if (error.empty()) add(axis, true);
    return error;
}

char side_of(const std::string& word) {
    const std::string_view words[] = {"oblique", "front", "back", "left", "right", "head", "foot"};
    return static_cast<char>('0' + (std::find(std::begin(words), std::end(words), word) - std::begin(words)));
}

ExitCode report_picked(const PickedBone& bone, const window::LandmarkList& list) {
    if (!list.all().empty()) print(bone.yaml(list.all()));
    return exit_pass;
}

/// Picks by rays, without a window.
ExitCode pick_by_rays(const LandmarksOptions& options, PickedBone& bone) {
    window::LandmarkList list;
    if (const std::string error = add_all(options, bone, list); !error.empty()) return complain(error, exit_bad_input);
    if (options.is_written) {
        if (const std::string error = bone.write(list.all()); !error.empty()) return complain(error, exit_bad_input);
        print(options.anatomy + "\n");
        list.clear();
    }
    if (!options.screenshot.empty()) {
        std::string error;
        const auto offscreen = window::Offscreen::open(picture_width, picture_height, error);
        if (offscreen == nullptr) return complain(text::with_memory_limit(error), exit_fault);
        std::string problem;
        const std::string why_not = window::draw_landmarks(
            bone, list, side_of(options.side),
            [&](const window::Pixels& pixels) { problem = write_picture(options.screenshot, pixels); });
        if (!why_not.empty()) return complain("no picture can be drawn: " + why_not, exit_fault);
        if (!problem.empty()) return complain(problem, exit_bad_input);
    }
    return report_picked(bone, list);
}

ExitCode pick_in_window(const LandmarksOptions& options, const std::shared_ptr<window::GlfwWindow>& window,
                        const Interruption& interruption, PickedBone& bone) {
    const auto save = [](const window::Pixels& pixels) {
        const std::string file = "landmarks.png", error = write_picture(file, pixels);
        print_error("kerf: " + (error.empty() ? "picture written to " + file : error) + "\n");
    };
    window::LandmarkList list;
    const std::string why_not =
        window::show_landmarks(*window, bone, list, save, [&] { return interruption.has_come(); });
    if (!list.all().empty()) print_error("kerf: not written into " + options.anatomy + ":\n");
    const ExitCode code = report_picked(bone, list);
    return why_not.empty() ? code : complain("the window cannot draw: " + why_not, exit_fault);
}

}  // namespace

ExitCode run_landmarks(const LandmarksOptions& options, const Installation& here) {
    std::string error;
    const auto spacing = spacing_of(options, error);
    if (!error.empty()) return complain(error, exit_bad_input);
    const bool has_rays = !options.points.empty() || !options.axes.empty();
    if (options.is_written && !has_rays)
        return complain(
            "`--write` has no landmarks to write. Add `--point` or `--axis`, or leave it out: the window can "
            "write, too.",
            exit_bad_input);
    const bool is_windowed = !has_rays && options.screenshot.empty();
    std::shared_ptr<window::GlfwWindow> window;
    if (is_windowed) {
        window = window::GlfwWindow::open("Kerf: landmarks", error);
        if (window == nullptr) return complain(text::with_memory_limit(error), exit_fault);
    }
    const Interruption interruption;
    std::atomic<double> fraction{0.0};
    const auto make = [&] {
        StillWorking sign_of_life("making the bone of " + options.anatomy);
        return PickedBone::make(options.anatomy, spacing, here.procedures(), [&](double done, const std::string& what) {
            sign_of_life.is_at(done, what);
            fraction = done;
        });
    };
    const auto made_behind_window = [&] {
        WindowDisplay display({.window = window});
        return done_behind(
            display, "Making the bone", [&] { return fraction.load(); }, make, [] {});
    };
    Made made = is_windowed ? made_behind_window() : make();
    if (!made.diagnostics().empty()) print_error(to_text(made.diagnostics()));
    if (!made) return exit_bad_input;
    return is_windowed ? pick_in_window(options, window, interruption, **made) : pick_by_rays(options, **made);
}

}  // namespace kerf::app
