// SPDX-License-Identifier: Apache-2.0
// Made bones: the dimensions that are drawn against their source, and the dimensions of the bone against the requested
// ones.
//
//     bench_bones [FOLDER]   prints the tables; writes bones-vertebrae.png, bones-femora.png, bones-mandibles.png
//
// A few minutes. For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/preview/png.h"
#include "app/preview/view.h"
#include "bench/into_folder.h"
#include "bone/import/make_body.h"
#include "documents/made/make_bone.h"
#include "documents/read_anatomy.h"
#include "text/write_file.h"

namespace {

using namespace kerf;
using documents::Dimension;
using documents::MakeRequest;
using Sex = MakeRequest::Sex;

MakeRequest vertebra(const std::string& level) { return {.kind = "vertebra", .level = level}; }

std::string name_of(const MakeRequest& bone) { return bone.level.empty() ? bone.kind : bone.kind + "/" + bone.level; }

/// Mean and standard deviation of drawn values against those of the source.
void print_draws() {
    constexpr std::uint32_t people = 10000;
    std::printf("10 000 draws of each bone and sex: the dimension farthest from its source\n");
    std::printf("bone            sex  redrawn [%%]  mean off by [%% of the mean]            SD off by [%%]\n");
    for (const MakeRequest& bone_request : documents::all_made_bones())
        for (const Sex sex : {Sex::female, Sex::male}) {
            MakeRequest request = bone_request;
            request.sex = sex;
            const documents::Population population = documents::population_of(request);
            std::map<std::string, std::array<double, 2>> sums;
            int redrawn = 0;
            for (std::uint32_t seed = 0; seed < people; ++seed) {
                MakeRequest person = request;
                person.seed = seed;
                const documents::DrawnBone bone = draw_bone(population, person);
                redrawn += bone.redraws > 0;
                for (const Dimension& d : population.dimensions) {
                    const double off = bone.values[d.name] - d.mean;
                    sums[d.name][0] += off / people, sums[d.name][1] += off * off / people;
                }
            }
            std::string of_mean, of_sd;
            double worst_mean = 0.0, worst_sd = 0.0;
            for (const Dimension& d : population.dimensions) {
                const auto [mean, square] = sums[d.name];
                const bool is_about_zero = d.unit == "deg" || d.mean == 0.0;
                const double off = is_about_zero ? 0.0 : 100.0 * mean / d.mean;
                const double sd_off = 100.0 * (std::sqrt(square - mean * mean) / d.sd - 1.0);
                if (std::abs(off) > std::abs(worst_mean)) worst_mean = off, of_mean = d.name;
                if (std::abs(sd_off) > std::abs(worst_sd)) worst_sd = sd_off, of_sd = d.name;
            }
            std::printf("%-15s %-4s %8.1f      %+5.1f  %-28s  %+5.1f  %s\n", name_of(request).c_str(),
                        sex == Sex::female ? "f" : "m", 100.0 * redrawn / people, worst_mean, of_mean.c_str(), worst_sd,
                        of_sd.c_str());
        }
}

/// Dimensions measured on bones against the requested ones.
void print_measures() {
    constexpr std::uint32_t people = 50;
    struct Off {
        double sum = 0.0, worst = 0.0;
        int within = 0, count = 0;
        std::string unit{};
    };
    std::map<std::string, Off> offs;
    for (const MakeRequest& bone_request : documents::all_made_bones())
        for (std::uint32_t seed = 0; seed < people; ++seed) {
            MakeRequest request = bone_request;
            request.seed = seed;
            const documents::MadeBone bone = make_bone(request);
            for (const documents::MeasuredDimension& measured : bone.measured) {
                const auto d = std::find_if(bone.population.dimensions.begin(), bone.population.dimensions.end(),
                                            [&](const Dimension& one) { return one.name == measured.name; });
                const bool is_angle = d->unit == "deg";
                const double off =
                    (measured.value - bone.drawn.values[measured.name]) * (is_angle ? 180.0 / std::numbers::pi : 1e3);
                Off& all = offs[request.kind + " " + measured.name];
                all.unit = d->unit;
                all.sum += off;
                if (std::abs(off) > std::abs(all.worst)) all.worst = off;
                all.within += std::abs(off) <= (is_angle ? 1.0 : 0.5);
                ++all.count;
            }
        }
    std::printf("\n50 people of each kind and level: measured less requested\n");
    std::printf("dimension                                mean   worst         within 0.5 mm or 1 deg [%%]\n");
    for (const auto& [name, off] : offs)
        std::printf("%-38s %+6.2f  %+6.2f  %-4s  %5.0f\n", name.c_str(), off.sum / off.count, off.worst,
                    off.unit.c_str(), 100.0 * off.within / off.count);
}

/// A direction to look from, and what is in the picture.
struct Side {
    Vec3 right, up;  ///< in the picture
    Vec3 centre;     ///< [m]
    double width;    ///< [m] of the picture
    double spacing;  ///< [m] of the bone's field
};
constexpr int tile_width = 240, tile_height = 250;  // [pixels]

/// Returns a bone from one side.
app::Picture picture_of(const MakeRequest& request, const Side& side) {
    const documents::MadeBone made = make_bone(request);
    text::Diagnostics diagnostics;
    auto anatomy = documents::read_anatomy_text(made.name, made.text).take(diagnostics);
    if (!anatomy) throw std::runtime_error(to_text(diagnostics));
    anatomy->zones.clear();
    run::Scene scene;
    auto body = bone::make_body(*anatomy, side.spacing).take(diagnostics);
    if (!body) throw std::runtime_error(to_text(diagnostics));
    scene.body = std::move(*body);
    scene.anatomy = std::move(*anatomy);
    app::View view{"", side.centre, side.right, side.up, side.width, tile_width, tile_height};
    return from_outside(view, scene, {});
}

void put(const app::Picture& one, int column, int row, app::Picture& sheet) {
    for (int y = 0; y < one.height; ++y)
        std::copy_n(one.rgb.begin() + 3 * y * one.width, 3 * one.width,
                    sheet.rgb.begin() + 3 * ((row * one.height + y) * sheet.width + column * one.width));
}

/// Draws rows of bones: one row for each request of the first person and side.
struct Row {
    std::vector<MakeRequest> bones;
    Side side;
};

void draw_sheet(const std::vector<Row>& rows, const std::string& file) {
    app::Picture sheet(static_cast<int>(rows.front().bones.size()) * tile_width,
                       static_cast<int>(rows.size()) * tile_height);
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t column = 0; column < rows[row].bones.size(); ++column)
            put(picture_of(rows[row].bones[column], rows[row].side), static_cast<int>(column), static_cast<int>(row),
                sheet);
    if (const std::string error = text::write_file(file, png_of(sheet)); !error.empty())
        throw std::runtime_error(error);
    std::printf("wrote %s\n", file.c_str());
}

/// Returns the bones of the first people.
std::vector<MakeRequest> people(const MakeRequest& bone, std::uint32_t count) {
    std::vector<MakeRequest> all(count, bone);
    for (std::uint32_t i = 0; i < count; ++i) all[i].seed = i + 1;
    return all;
}

constexpr Vec3 left{1, 0, 0}, right{-1, 0, 0}, behind{0, 1, 0}, front{0, -1, 0}, head{0, 0, 1};

void draw_vertebrae(const std::string& folder) {
    const auto side = [](Vec3 to_right, Vec3 up) { return Side{to_right, up, {0, 0.026, -0.002}, 0.105, 0.5e-3}; };
    std::vector<MakeRequest> levels;
    for (const char* level : {"L1", "L2", "L3", "L4", "L5"}) levels.push_back(vertebra(level));
    draw_sheet({{levels, side(right, front)},
                {levels, side(behind, head)},
                {levels, side(right, head)},
                {people(vertebra("L3"), 5), side(right, front)}},
               folder + "/bones-vertebrae.png");
}

void draw_femora(const std::string& folder) {
    const std::vector<MakeRequest> upper = people({.kind = "femur", .level = "proximal"}, 3),
                                   lower = people({.kind = "femur", .level = "distal"}, 3);
    draw_sheet({{upper, {left, head, {-0.02, 0, -0.02}, 0.16, 0.6e-3}},
                {upper, {behind, head, {-0.02, 0, -0.02}, 0.16, 0.6e-3}},
                {lower, {left, head, {0, 0, -0.005}, 0.16, 0.6e-3}},
                {lower, {right, behind, {0, 0.025, 0}, 0.16, 0.6e-3}}},
               folder + "/bones-femora.png");
}

void draw_mandibles(const std::string& folder) {
    const auto side = [](Vec3 to_right, Vec3 up) { return Side{to_right, up, {0, -0.036, 0.018}, 0.14, 0.5e-3}; };
    const MakeRequest mean{.kind = "mandible", .level = ""};
    std::vector<MakeRequest> jaws = people(mean, 3);
    jaws.insert(jaws.begin(), mean);
    draw_sheet({{jaws, side(right, front)}, {jaws, side(behind, head)}, {jaws, side(left, head)}},
               folder + "/bones-mandibles.png");
}

}  // namespace

int main(int argc, char** argv) {
    return run_into_folder(argc, argv, [](const std::string& folder) {
        print_draws();
        print_measures();
        if (folder.empty()) return 0;
        draw_vertebrae(folder);
        draw_femora(folder);
        draw_mandibles(folder);
        return 0;
    });
}
