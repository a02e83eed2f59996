// SPDX-License-Identifier: Apache-2.0
// Grades of ten screws that are put wrong on purpose into a vertebra of boxes by procedures/pedicle-screw.yaml, and of
// one that is not.
//
//     bench_screw_grades [FOLDER]   prints the table; writes screw-grades.svg into the folder
//
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "kerf/units.hpp"
#include "run/verdict/cut_results.h"
#include "run/verdict/screw_grade.h"
#include "studies/drawing/cells.h"
#include "studies/drawing/plot.h"
#include "studies/drawing/svg.h"
#include "text/write_file.h"

namespace {

using namespace kerf;
using namespace literals;

struct Wrong {
    const char* name;
    double medial, cranial;              ///< [m] beside the planned axis
    double medial_angle, cranial_angle;  ///< [rad] about the planned entry
    double depth;                        ///< [m] of the tip
};
constexpr std::array screws{
    Wrong{"as planned", 0, 0, 0, 0, 35.0_mm},           Wrong{"2 mm medial", 2.0_mm, 0, 0, 0, 35.0_mm},
    Wrong{"4 mm medial", 4.0_mm, 0, 0, 0, 35.0_mm},     Wrong{"7 mm medial", 7.0_mm, 0, 0, 0, 35.0_mm},
    Wrong{"4 mm lateral", -4.0_mm, 0, 0, 0, 35.0_mm},   Wrong{"6 mm lateral", -6.0_mm, 0, 0, 0, 35.0_mm},
    Wrong{"6 mm caudal", 0, -6.0_mm, 0, 0, 35.0_mm},    Wrong{"7 mm cranial", 0, 7.0_mm, 0, 0, 35.0_mm},
    Wrong{"15 deg medial", 0, 0, 15.0_deg, 0, 35.0_mm}, Wrong{"15 deg lateral", 0, 0, -15.0_deg, 0, 35.0_mm},
    Wrong{"26 mm too deep", 0, 0, 0, 0, 61.0_mm}};

run::Scene vertebra(const PluginRegistry& plugins) {
    text::Diagnostics diagnostics;
    auto scene = run::make_scene(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml",
                                 KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml", plugins)
                     .take(diagnostics);
    if (!scene) throw std::runtime_error(to_text(diagnostics));
    return std::move(*scene);
}

Vec3 cranial_of(const run::AxisFrame& frame) {
    const Vec3 up = cross(frame.medial, frame.along);
    return up.z >= 0.0 ? up : -up;
}

Pose pose_of(const Wrong& wrong, const run::AxisFrame& frame) {
    const Vec3 cranial = cranial_of(frame);
    const Vec3 along =
        normalized(frame.along + std::tan(wrong.medial_angle) * frame.medial + std::tan(wrong.cranial_angle) * cranial);
    const Vec3 entry = frame.entry + wrong.medial * frame.medial + wrong.cranial * cranial;
    return {entry + wrong.depth / dot(along, frame.along) * along, quat_between({0, 0, 1}, along)};
}

// ---- the picture: each screw in the section that shows it best ----------------------------------------------------

constexpr double tile = 190.0, gap = 12.0, pixels = 2700.0;  // [px], [px], [px/m]
constexpr int across = 4;

/// A section through the planned axis and `aside`, 70 mm wide.
std::string tile_svg(const run::Scene& scene, const run::AxisFrame& frame, const Wrong& wrong,
                     const std::string& grades, double left, double top) {
    const bool is_sagittal = wrong.cranial != 0.0 || wrong.cranial_angle != 0.0;
    const Vec3 aside = is_sagittal ? cranial_of(frame) : frame.medial;
    const drawing::CellArea area{.x_low = -35.0_mm,
                                 .x_high = 35.0_mm,
                                 .y_low = -8.0_mm,
                                 .y_high = 62.0_mm,
                                 .cell = 0.5_mm,
                                 .left = left + 0.5 * tile - 35.0_mm * pixels,
                                 .top = top,
                                 .pixels = pixels};
    std::string svg = "<rect x=\"" + drawing::px(left) + "\" y=\"" + drawing::px(top) + "\" width=\"" +
                      drawing::px(tile) + "\" height=\"" + drawing::px(tile) + "\" fill=\"#f4f5f7\"/>\n";
    svg += drawing::cells_svg(
        area,
        [&](double beside, double depth) {
            const Vec3 at = frame.entry + depth * frame.along + beside * aside;
            return uncut_distance(scene.body, locate(scene.body, at)) < 0.0 ? 1 : 0;
        },
        [](int) { return std::string("#dcc9a0"); });
    const Pose screw = pose_of(wrong, frame);
    const Vec3 along = rotate(screw.rotation, {0, 0, 1});
    const auto at = [&](Vec3 p) {
        return "x=\"" + drawing::px(area.px_of_x(dot(p - frame.entry, aside))) + "\" y=\"" +
               drawing::px(area.px_of_y(frame.depth_of(p))) + "\"";
    };
    const auto end = [&](Vec3 p, const char* n) {
        std::string text = at(p);
        text.replace(text.find("x="), 1, std::string("x") + n);
        text.replace(text.find(" y="), 2, std::string(" y") + n);
        return text;
    };
    const char* colour = grades.starts_with("A") ? "#1b7f4b" : grades.starts_with("B") ? "#c8881a" : "#b3261e";
    svg += "<line " + end(screw.position - 40.0_mm * along, "1") + " " + end(screw.position, "2") + " stroke=\"" +
           colour + "\" stroke-opacity=\"0.75\" stroke-width=\"" + drawing::px(6.5_mm * pixels) + "\"/>\n";
    svg += "<line " + end(frame.entry - 8.0_mm * frame.along, "1") + " " +
           end(frame.entry + 62.0_mm * frame.along, "2") +
           " stroke=\"#444\" stroke-width=\"1\" stroke-dasharray=\"5 4\"/>\n";
    svg += drawing::text_at(left, top + tile + 15.0, wrong.name);
    svg += drawing::text_at(left + tile, top + tile + 15.0, grades, "text-anchor=\"end\" font-weight=\"bold\"");
    return svg;
}

}  // namespace

int main(int argc, char** argv) {
    PluginRegistry plugins;
    plugins.scan({KERF_BUILD_DIR "/lib/kerf"});
    const run::Scene scene = vertebra(plugins);
    const std::size_t step = scene.procedure.steps.size() - 1;
    const run::AxisFrame& frame = scene.frames[step];
    std::string svg;
    std::printf("%-16s %10s  %-18s %s\n", "screw", "breach mm", "Gertzbein-Robbins", "Heary");
    for (std::size_t i = 0; i < screws.size(); ++i) {
        const run::HoleResult found = run::screw_at(scene, step, frame, scene.body, pose_of(screws[i], frame));
        if (!found.screw) throw std::runtime_error(std::string("no grade of ") + screws[i].name);
        const std::string grade = run::gertzbein_robbins(found.screw->least, found.screw->most);
        std::printf("%-16s %10.2f  %-18s %s\n", screws[i].name, found.screw->breach.worst() / 1.0_mm, grade.c_str(),
                    found.screw->heary_grade.c_str());
        const auto column = i % across, row = i / across;
        svg +=
            tile_svg(scene, frame, screws[i], grade + ", " + found.screw->heary_grade,
                     gap + static_cast<double>(column) * (tile + gap), 40.0 + static_cast<double>(row) * (tile + 32.0));
    }
    if (argc < 2) return 0;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    const double rows = std::ceil(static_cast<double>(screws.size()) / across);
    const std::string error = text::write_file(
        folder / "screw-grades.svg",
        drawing::picture(across * (tile + gap) + gap, 40.0 + rows * (tile + 32.0) + 10.0,
                         "Ten screws put wrong on purpose: grade of Gertzbein and Robbins, grade of Heary", svg));
    if (!error.empty()) std::fprintf(stderr, "%s\n", error.c_str());
    return error.empty() ? 0 : 1;
}
