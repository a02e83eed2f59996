// SPDX-License-Identifier: Apache-2.0
// Where the holes of procedures/pedicle-screw.yaml end up, on every device and bone, with a starting hole and without.
//
//     bench_hole_places [FOLDER]   prints the table; writes holes-BONE.svg and offset-over-tilt.svg into the folder
//
// The scans are those of KERF_DATA; without it the phantoms alone. For training and research; not for diagnosis,
// planning or deciding treatment.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/into_folder.h"
#include "kerf/units.hpp"
#include "run/run_procedure.h"
#include "run/scene.h"
#include "studies/drawing/cells.h"
#include "studies/drawing/plot.h"
#include "studies/drawing/svg.h"
#include "tests/support/drill_rig.h"
#include "text/write_file.h"

namespace {

using namespace kerf;
using namespace literals;
using test::plugins;

constexpr const char* procedure_file = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";
constexpr std::array devices{"touch", "desktop", "premium-1.5-6dof", "omega.6"};
constexpr std::array rehearsals{"expert", "no-starting-hole"};

struct Bone {
    const char* name;
    const char* anatomy;  ///< empty: the procedure's own
    const char* variant;
};
constexpr std::array phantoms{Bone{"phantom", KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml", ""},
                              Bone{"steep", "", "steep-facet"}};
constexpr std::array scans{Bone{"L3", KERF_SOURCE_DIR "/tests/real-data/l3.yaml", ""},
                           Bone{"T12", KERF_SOURCE_DIR "/tests/real-data/t12.yaml", ""}};

run::Scene scene_of(const Bone& bone, std::vector<std::string> settings) {
    text::Diagnostics diagnostics;
    run::DocumentRequest request{.procedure = procedure_file, .anatomy = bone.anatomy};
    request.changes = {bone.variant, std::move(settings)};
    auto documents = run::check_documents(request, plugins()).take(diagnostics);
    auto scene = documents ? make_scene(std::move(*documents)).take(diagnostics) : std::nullopt;
    if (!scene) throw std::runtime_error(to_text(diagnostics));
    return std::move(*scene);
}

/// A run, and where its tip was while bone resisted it.
struct Drilled {
    run::RunOutcome outcome;
    std::vector<Vec3> path;
};
Drilled drilled(const run::Scene& scene, const char* rehearsal) {
    struct Path final : run::RunObserver {
        std::vector<Vec3> points;
        void on_tick(const session::TickRow& row) override {
            const Vec3 tip = row.world_from_tool.position;
            if (row.thrust > 0.0 && (points.empty() || length(tip - points.back()) > 0.1_mm)) points.push_back(tip);
        }
    } path;
    run::RunRequest request;
    request.rehearsal = rehearsal;
    request.observers = {&path};
    run::RunOutcome outcome = run::run_procedure(scene, plugins(), request);
    return {std::move(outcome), std::move(path.points)};
}

std::optional<double> metric(const session::RunSummary& summary, const std::string& name) {
    for (const session::MetricRow& row : summary.metrics)
        if (row.id == "pilot-hole." + name) return row.value / row.per_unit;
    return std::nullopt;
}
std::string shown(const std::optional<double>& value) { return value ? drawing::figure(*value, 3) : "–"; }

// ---- the table ---------------------------------------------------------------------------------------------------

constexpr std::array columns{"entry-offset", "narrowest-offset", "end-offset", "hole-angle", "breach", "time-in-air"};

/// Largest less smallest of a metric over the devices, where all have it.
std::string spread(const std::vector<session::RunSummary>& runs, const char* name) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const session::RunSummary& run : runs) {
        const auto value = metric(run, name);
        if (!value) return "–";
        least = std::min(least, *value);
        most = std::max(most, *value);
    }
    return drawing::figure(most - least, 2);
}

// ---- the picture of a bone's holes -------------------------------------------------------------------------------

constexpr double shown_before = 8.0_mm, shown_behind = 40.0_mm, shown_beside = 18.0_mm;  // of the planned entry
constexpr double pixels = 8e3;                                                           // a metre
constexpr double top = 64.0;

/// One section along the planned axis.
struct View {
    const run::Scene* scene;
    Vec3 aside;  ///< to the right
    drawing::CellArea area;

    View(const run::Scene& of, Vec3 to_the_right, double left)
        : scene(&of),
          aside(to_the_right),
          area{.x_low = -shown_beside,
               .x_high = shown_beside,
               .y_low = -shown_before,
               .y_high = shown_behind,
               .cell = 0.5_mm,
               .left = left,
               .top = top,
               .pixels = pixels} {}
};

/// Bone by its density.
std::string bone_svg(const View& view) {
    constexpr int shades = 6;
    const run::AxisFrame& frame = view.scene->frames.front();
    const Body& body = view.scene->body;
    const auto shade_at = [&](double beside, double depth) {
        const LocatedPoint place = locate(body, frame.entry + depth * frame.along + beside * view.aside);
        if (uncut_distance(body, place) >= 0.0) return 0;
        double weight[KERF_MAX_TISSUES], density = 0.0;
        material_weights(body, place, weight);
        for (std::size_t m = 0; m < body.materials.size(); ++m)
            density += weight[m] * body.materials[m].densities.at(place, body.materials[m].density);
        return 1 + std::clamp(static_cast<int>(density / 1850.0 * shades), 0, shades - 1);
    };
    return drawing::cells_svg(view.area, shade_at, [](int shade) {
        const int grey = 225 - 22 * shade;
        return "rgb(" + std::to_string(grey) + "," + std::to_string(grey - 4) + "," + std::to_string(grey - 14) + ")";
    });
}

std::string path_svg(const View& view, const std::vector<Vec3>& path, const char* colour, double width,
                     const char* more = "") {
    const run::AxisFrame& frame = view.scene->frames.front();
    std::string svg = std::string("<polyline fill=\"none\" stroke=\"") + colour + "\" stroke-width=\"" +
                      drawing::px(width) + "\" stroke-linecap=\"round\" stroke-linejoin=\"round\" " + more +
                      " points=\"";
    for (const Vec3 tip : path) {
        const double depth = frame.depth_of(tip), beside = dot(tip - frame.entry, view.aside);
        if (std::abs(beside) > shown_beside || depth < -shown_before || depth > shown_behind) continue;
        svg += drawing::px(view.area.px_of_x(beside)) + "," + drawing::px(view.area.px_of_y(depth)) + " ";
    }
    return svg + "\"/>\n";
}

std::string picture_of(const Bone& bone, const run::Scene& scene, const std::map<std::string, Drilled>& runs) {
    const run::AxisFrame& frame = scene.frames.front();
    const Vec3 medial = frame.medial, up = cross(medial, frame.along);
    const Vec3 cranial = up.z >= 0.0 ? up : -up;
    constexpr double gap = 40.0, drill = 3.2_mm;
    const double width = 2.0 * shown_beside * pixels;
    std::string svg;
    for (const auto& [aside, title, at] :
         {std::tuple{medial, "lateral → medial", 20.0}, std::tuple{cranial, "caudal → cranial", 20.0 + width + gap}}) {
        const View view(scene, aside, at);
        svg += drawing::text_at(at + 0.5 * width, 52.0, title, "text-anchor=\"middle\"");
        svg += bone_svg(view);
        svg += path_svg(view, runs.at("expert").path, "#0072b2", drill * pixels, "stroke-opacity=\"0.45\"");
        svg += path_svg(view, runs.at("no-starting-hole").path, "#d55e00", drill * pixels, "stroke-opacity=\"0.45\"");
        const std::vector<Vec3> planned{frame.entry - shown_before * frame.along, frame.entry + 32.0_mm * frame.along};
        svg += path_svg(view, planned, "#444", 1.5, "stroke-dasharray=\"6 4\"");
    }
    const double below = View(scene, medial, 20.0).area.px_of_y(shown_behind) + 24.0;
    svg += drawing::text_at(20.0, below,
                            "planned axis: dashed; with a starting hole: blue; without: orange. 3.2 mm drill.");
    return drawing::picture(40.0 + 2.0 * width + gap, below + 20.0,
                            std::string("Pilot holes, ") + bone.name + ", " + scene.device->id, svg);
}

// ---- offset over tilt --------------------------------------------------------------------------------------------

/// How far the hole lies beside its way where the tip is 4 mm deep, of a hand that goes straight in at an angle [m].
double offset_at(double angle_deg, double push) {
    const std::string angle = drawing::figure(angle_deg) + " deg";
    const auto point = [&](const char* depth) {
        return std::string("{depth: ") + depth + " mm, cranial_angle: " + angle + "}";
    };
    const run::Scene scene =
        scene_of(phantoms[0], {"rehearsals.no-starting-hole.path=[" + point("-5") + ", " + point("8") + "]",
                               "rehearsals.no-starting-hole.hand.push=" + drawing::figure(push) + " N"});
    const run::AxisFrame& frame = scene.frames.front();
    const Pose way = frame.pose_at({.depth = 0.0, .cranial_angle = angle_deg * 1.0_deg});
    const Vec3 along = rotate(way.rotation, {0, 0, 1});
    double offset = 0.0;
    for (const Vec3 tip : drilled(scene, "no-starting-hole").path) {
        const double depth = dot(tip - frame.entry, along);
        if (depth > 4.0_mm) break;
        offset = length(tip - frame.entry - depth * along);
    }
    return offset;
}

std::string offset_over_tilt() {
    drawing::Panel panel{
        .title = "Start without a starting hole: offset at 4 mm depth over the tilt of the face",
        .x = {.title = "tilt of the drill against the face's normal [deg]", .is_log = false, .low = 10.0, .high = 45.0},
        .y = {.title = "offset [mm]", .is_log = false, .low = 0.0, .high = 8.0}};
    std::printf("\noffset at 4 mm depth over tilt, premium-1.5-6dof\n  %6s %10s %10s\n", "deg", "20 N", "40 N");
    drawing::Curve weak{.name = "20 N", .colour = 0}, strong{.name = "40 N", .colour = 1};
    for (const double cranial : {0.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0}) {
        // The plain phantom's facet stands at 14.4 degrees to the axis, across this angle.
        const double tilt = std::acos(std::cos(14.4_deg) * std::cos(cranial * 1.0_deg)) / 1.0_deg;
        const double at_20 = offset_at(cranial, 20.0) / 1.0_mm, at_40 = offset_at(cranial, 40.0) / 1.0_mm;
        std::printf("  %6.1f %10.2f %10.2f\n", tilt, at_20, at_40);
        std::fflush(stdout);
        weak.markers.push_back({.x = tilt, .y = at_20});
        strong.markers.push_back({.x = tilt, .y = at_40});
    }
    panel.curves = {weak, strong};
    return drawing::picture(640, 420, "Offset over tilt", drawing::panel_svg(panel, 0, 40, 640, 370));
}

int run(const std::string& folder) {
    std::printf("For training and research; not for diagnosis, planning or deciding treatment.\n"
                "offsets and breach in mm, angle in degrees, time in seconds\n\n%-8s %-17s %-17s %-10s",
                "bone", "rehearsal", "device", "verdict");
    for (const char* column : columns) std::printf(" %16s", column);
    std::printf("\n");
    std::vector<Bone> bones(phantoms.begin(), phantoms.end());
    if (std::getenv("KERF_DATA") != nullptr) bones.insert(bones.end(), scans.begin(), scans.end());
    for (const Bone& bone : bones) {
        std::map<std::string, Drilled> pictured;
        std::optional<run::Scene> seen;
        for (const char* rehearsal : rehearsals) {
            std::vector<session::RunSummary> runs;
            for (const char* device : devices) {
                run::Scene scene = scene_of(bone, {std::string("haptics.device=") + device});
                Drilled one = drilled(scene, rehearsal);
                std::printf("%-8s %-17s %-17s %-10s", bone.name, rehearsal, device,
                            to_text(one.outcome.summary.verdict));
                for (const char* column : columns)
                    std::printf(" %16s", shown(metric(one.outcome.summary, column)).c_str());
                std::printf("\n");
                std::fflush(stdout);
                runs.push_back(one.outcome.summary);
                if (std::string(device) == "premium-1.5-6dof") {
                    pictured.insert_or_assign(rehearsal, std::move(one));
                    seen.emplace(std::move(scene));
                }
            }
            std::printf("%-8s %-17s %-17s %-10s", bone.name, rehearsal, "spread", "");
            for (const char* column : columns) std::printf(" %16s", spread(runs, column).c_str());
            std::printf("\n");
        }
        if (folder.empty()) continue;
        std::string name = bone.name;
        std::transform(name.begin(), name.end(), name.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
        if (const std::string error =
                text::write_file(folder + "/holes-" + name + ".svg", picture_of(bone, *seen, pictured));
            !error.empty())
            throw std::runtime_error(error);
    }
    const std::string tilt = offset_over_tilt();
    if (folder.empty()) return 0;
    const std::string error = text::write_file(folder + "/offset-over-tilt.svg", tilt);
    if (!error.empty()) throw std::runtime_error(error);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return kerf::run_into_folder(argc, argv, ::run); }
