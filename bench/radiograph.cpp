// SPDX-License-Identifier: Apache-2.0
// Radiographs of the shipped vertebra L3 and proximal femur: time of the image of attenuation at first and after a hole
// was drilled, and of a picture of 512 × 512 pixels.
//
//     bench_radiograph [--pictures FOLDER] [--repeat N]   prints the table; writes PNG files into the folder
//
// For training and research; not for diagnosis, planning or deciding treatment.
#include "bone/radiograph/radiograph.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/preview/png.h"
#include "bone/radiograph/bone_shadow.h"
#include "core/field/pieces/present_bone.h"
#include "core/plugin/loader.h"
#include "kerf/units.hpp"
#include "run/scene.h"
#include "tests/bone/radiograph/plain_rays.h"
#include "text/write_file.h"

namespace {

using namespace kerf;
using namespace literals;

struct Options {
    std::string folder{};
    int repeat = 20;
};

/// Processor time of this process [ms].
double now() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

void print_times(const std::string& name, std::vector<double> times) {
    std::sort(times.begin(), times.end());
    const auto at = [&](double part) {
        return times[std::min(times.size() - 1, static_cast<std::size_t>(part * static_cast<double>(times.size())))];
    };
    std::printf("%-44s %8.1f %8.1f   (%zu)\n", name.c_str(), at(0.5), at(0.999), times.size());
}

void measure(const std::string& name, int repeat, const std::function<void()>& work) {
    std::vector<double> times;
    for (int i = 0; i < repeat; ++i) {
        const double start = now();
        work();
        times.push_back(now() - start);
    }
    print_times(name, std::move(times));
}

/// A metal surface, in the frame of its tool.
struct Mesh {
    std::vector<std::array<float, 3>> positions{};
    std::vector<std::array<std::uint32_t, 3>> triangles{};
};

/// Returns the surface of a tool's outline, turned about z; over its thread the radius follows the crests of a helix.
/// `count` points of the outline, from the tip.
Mesh turned(const std::vector<kerf_profile_point>& outline, std::size_t count, double thread_radius, double lead,
            std::size_t threaded) {
    constexpr std::uint32_t sides = 48;
    struct Ring {
        double z, radius;
        bool is_threaded;
    };
    std::vector<Ring> rings;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const bool is_threaded = lead > 0.0 && i + 1 < threaded;
        const double length = outline[i].z - outline[i + 1].z;
        const int steps = is_threaded ? std::max(1, static_cast<int>(std::ceil(length / (lead / 12.0)))) : 1;
        for (int s = 0; s < steps; ++s) {
            const double t = static_cast<double>(s) / steps;
            rings.push_back({outline[i].z - t * length,
                             outline[i].radius + t * (outline[i + 1].radius - outline[i].radius),
                             is_threaded && outline[i].radius + t > 0.0});
        }
    }
    rings.push_back({outline[count - 1].z, outline[count - 1].radius, false});

    Mesh mesh;
    const auto add = [&](double x, double y, double z) {
        mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    };
    add(0, 0, rings.front().z);
    for (const Ring& ring : rings)
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / sides;
            double radius = ring.radius;
            if (ring.is_threaded && thread_radius > radius) {
                const double turn = ring.z / lead + static_cast<double>(i) / sides, phase = turn - std::floor(turn);
                radius += (thread_radius - radius) * std::max(0.0, 1.0 - 3.0 * std::abs(phase - 0.5));
            }
            add(radius * std::cos(angle), radius * std::sin(angle), ring.z);
        }
    add(0, 0, rings.back().z);
    const auto at = [](std::size_t ring, std::uint32_t i) {
        return static_cast<std::uint32_t>(1 + ring * sides + i % sides);
    };
    const auto end = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (std::uint32_t i = 0; i < sides; ++i) {
        mesh.triangles.push_back({0, at(0, i), at(0, i + 1)});
        for (std::size_t r = 0; r + 1 < rings.size(); ++r) {  // z falls from ring to ring
            mesh.triangles.push_back({at(r, i), at(r + 1, i), at(r + 1, i + 1)});
            mesh.triangles.push_back({at(r, i), at(r + 1, i + 1), at(r, i + 1)});
        }
        mesh.triangles.push_back({end, at(rings.size() - 1, i + 1), at(rings.size() - 1, i)});
    }
    return mesh;
}

Mesh surface_of(const Tool& tool) {
    const ToolOutline& outline = tool.outline;
    return turned(outline.profile, outline.profile.size(), outline.thread_radius, outline.thread_lead,
                  outline.thread_count);
}

run::Scene scene_of(const char* procedure, const PluginRegistry& plugins) {
    text::Diagnostics diagnostics;
    auto scene =
        run::make_scene(std::string(KERF_SOURCE_DIR "/procedures/") + procedure, "", plugins).take(diagnostics);
    if (!scene) throw std::runtime_error(to_text(diagnostics));
    return std::move(*scene);
}

struct View {
    std::string name;
    bone::Beam beam;
};

void save(const bone::Radiograph& picture, const std::string& file) {
    if (!picture.error.empty()) throw std::runtime_error(picture.error);
    app::Picture out(picture.columns, picture.rows);
    for (std::size_t i = 0; i < picture.grey.size(); ++i)
        std::fill_n(out.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, picture.grey[i]);
    if (const std::string error = text::write_file(file, png_of(out)); !error.empty()) throw std::runtime_error(error);
    std::printf("wrote %s\n", file.c_str());
}

/// Prints how far the shadow of bone differs from plain rays, as a root mean square over pixels.
void print_difference(const bone::AttenuationImage& image, const bone::Beam& beam) {
    const bone::BoneShadow shadow = bone_shadow(image, beam);
    double squares = 0.0, largest = 0.0;
    int count = 0;
    for (int r = 4; r < beam.rows; r += 16)
        for (int c = 4; c < beam.columns; c += 16, ++count) {
            const double exact = test::marched(image, beam.source, beam.pixel_centre(c, r));
            const double off = static_cast<double>(shadow.bone[static_cast<std::size_t>(r * beam.columns + c)]) - exact;
            squares += off * off;
            largest = std::max(largest, exact);
        }
    std::printf("    differs from plain rays by %.2f %% of the largest depth, %.2f\n",
                100.0 * std::sqrt(squares / count) / largest, largest);
}

/// One bone with a metal shape, from several sides.
struct Case {
    std::string name;
    const Body& body;
    double hole;             ///< [m] radius
    Pose world_from_hole{};  ///< tip of the hole, +z into the bone
    Mesh metal{};
    Pose world_from_metal{};
    std::vector<View> views{};
};

void run_case(const Case& one, const Options& options) {
    PresentBone present(one.body, 65536);
    const Box box = bone::bone_box(one.body, identity_pose());
    const std::vector<bone::BodyInImage> bodies(1);
    BoneImage whole = present.image();
    bone::AttenuationImage image;
    measure(one.name + ": image at first", std::max(3, options.repeat / 4), [&] {
        image = bone::AttenuationImage::around(box);
        image.update(whole, bodies);
    });
    const auto [nx, ny, nz] = image.voxels();
    std::printf("    %d x %d x %d voxels of %.3f mm\n", nx, ny, nz, 1e3 * image.spacing());
    const bone::AttenuationImage uncut = image;

    const ToolSolid bit({{0.0, one.hole}, {-0.2, one.hole}});
    CutRecord record;
    record.from = record.to = one.world_from_hole;
    (void)present.apply(record, bit);
    const BoneImage drilled = present.image();
    std::vector<double> times;
    for (int i = 0; i < options.repeat; ++i) {
        image = uncut;
        const double start = now();
        image.update(drilled, bodies);
        times.push_back(now() - start);
    }
    print_times(one.name + ": image after a drilled hole", times);
    std::printf("    %zu voxels made anew\n", image.updated_voxels());
    double turn = 0.0;
    bone::AttenuationImage moved = image;
    measure(one.name + ": image after a motion", std::max(3, options.repeat / 4), [&] {
        const Pose pose{{0, 0, 0}, quat_from_rotation_vector({0, 0, turn += 0.01})};
        moved.update(drilled, std::vector{bone::BodyInImage{pose}});
    });

    const bone::MetalShape metal{one.metal.positions, one.metal.triangles, one.world_from_metal,
                                 bone::titanium_attenuation};
    for (const View& view : one.views) {
        std::uint64_t shot = 0;
        measure(one.name + ": radiograph, " + view.name, options.repeat,
                [&] { (void)bone::radiograph(image, view.beam, std::span(&metal, 1), {.shot = ++shot}); });
        print_difference(image, view.beam);
        if (options.folder.empty()) continue;
        const std::string file = options.folder + "/" + one.name + "-" + view.name;
        save(bone::radiograph(uncut, view.beam, {}), file + ".png");
        save(bone::radiograph(image, view.beam, {}), file + "-drilled.png");
        save(bone::radiograph(image, view.beam, std::span(&metal, 1)), file + "-screw.png");
    }
}

void vertebra(const PluginRegistry& plugins, const Options& options) {
    const run::Scene scene = scene_of("pedicle-screw.yaml", plugins);
    const std::size_t step = scene.procedure.steps.size() - 1;
    const run::AxisFrame& frame = scene.frames[step];
    const Quat along = quat_between({0, 0, 1}, frame.along);
    const Pose tip{frame.entry + 35.0_mm * frame.along, along};
    const Vec3 middle{0, 20.0_mm, 0};
    const bone::CArm arm{.width = 0.2};
    constexpr double quarter = 0.5 * std::numbers::pi;
    run_case({"L3",
              scene.body,
              1.6_mm,
              tip,
              surface_of(scene.tool(step)),
              tip,
              {{"AP", bone::beam(middle, 0.0, 0.0, arm)},
               {"lateral", bone::beam(middle, quarter, 0.0, arm)},
               {"oblique", bone::beam(middle, 0.6, 0.3, arm)}}},
             options);
}

void femur(const PluginRegistry& plugins, const Options& options) {
    const run::Scene scene = scene_of("trochanter-fixation.yaml", plugins);
    std::size_t step = 0;
    while (scene.procedure.steps[step].id != "lag") ++step;
    const run::AxisFrame& frame = scene.frames[step];
    const Pose tip{frame.entry + 80.0_mm * frame.along, quat_between({0, 0, 1}, frame.along)};
    const Vec3 middle{-20.0_mm, 0, 0};
    constexpr double quarter = 0.5 * std::numbers::pi;
    run_case({"femur",
              scene.whole ? *scene.whole : scene.body,
              2.25_mm,
              tip,
              surface_of(scene.tool(step)),
              tip,
              {{"AP", bone::beam(middle, 0.0, 0.0)},
               {"lateral", bone::beam(middle, quarter, 0.0)},
               {"oblique", bone::beam(middle, 0.6, 0.3)}}},
             options);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        Options options;
        for (int i = 1; i + 1 < argc; i += 2) {
            const std::string name = argv[i];
            if (name == "--pictures") options.folder = argv[i + 1];
            if (name == "--repeat") options.repeat = std::max(1, std::atoi(argv[i + 1]));
        }
        if (!options.folder.empty()) std::filesystem::create_directories(options.folder);
        PluginRegistry plugins;
        plugins.scan({KERF_BUILD_DIR "/lib/kerf"});
        std::printf("%-44s %8s %8s   processor time [ms], (count)\n", "", "median", "p99.9");
        vertebra(plugins, options);
        femur(plugins, options);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
