// SPDX-License-Identifier: Apache-2.0
// Exact surfaces, on one thread: what a step of a saw costs, with the host's checks, in meshes of any size.
//
//     steps      a blade that leaves 0.4 mm, 34 mm wide, in steps of 0.1 mm with a stroke of 3 mm, from 8 mm deep on.
//                local: the strategy of that name, the patch cut out and put back, all checks. asked: of that the
//                strategy alone. whole: all of the mesh through CGAL's corefinement with rounded points for each step,
//                its parts tapered alike, without any check
//     cut        what one slot takes as a whole: `exact` once, `local` step by step; volume against `exact`
//     long       four slots in 2000 steps of 0.05 mm: median of the first and of the last tenth, faces, pieces
//     displace   a groove 12 mm long and 1 mm deep by a ball burr of 4 mm, in steps: error next to the volume by hand,
//                cost and quality of `displace` at three tolerances, of `local`, `exact` and the field
//     picture    wire-frame of a slot, to FILE.svg
//     groove     wire-frame of a groove by `displace`, to FILE.svg
//     coplanar   random cuts with walls through vertices, in the plane of faces, or along an old cut: how many end
//                closed and free of crossings
//
// Usage: bench_remesh [steps|cut|long|displace|coplanar COUNT|picture FILE.svg|groove FILE.svg]. Without arguments: all
// but the pictures, coplanar with 200 cases. Times on the processor, so that what else the machine does is not counted.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bench/strategy_modules.h"
#include "bone/remesh/accept.h"
#include "bone/remesh/local_cutting.h"
#include "bone/surface/edges.h"
#include "studies/chart/surfaces/burr_on_slab.h"
#include "studies/chart/surfaces/groove_surfaces.h"
#include "studies/times.h"
#include "tests/support/sawn_tube.h"

namespace {

using namespace kerf;
using namespace literals;
using test::bent_bone, test::blade_at, test::cut_across, test::slot_blade;

bench::StrategyModules strategies;

bone::RemeshResult ask(const char* strategy, const bone::RemeshRequest& request) {
    return strategies.ask(strategy, request);
}

std::string flaw_of(const bone::TaggedMesh& base, const bone::LocalCutting& cutting) {
    for (const auto& stale : cutting.stale()) return stale.why;
    bone::RemeshRequest request;
    request.base = base;
    return bone::flaw_of_result(request, cutting.surface().mesh());
}

void steps() {
    const ToolSolid blade = slot_blade();
    std::printf("steps of 0.1 mm                 ms a step\n");
    std::printf("%10s  %8s %8s  %8s  %8s %8s  %6s  %s\n", "triangles", "local", "p99", "asked", "whole", "p99", "ratio",
                "refused");
    for (const double size : {5e3, 8e3, 20e3, 80e3, 200e3, 320e3}) {
        const bone::TaggedMesh bone = bone::tagged(bent_bone(size));
        std::vector<double> local, asked, whole;
        double in_strategy = 0.0;
        bone::LocalCutting saw(bone, {&blade}, 20e-6, [&](const bone::RemeshRequest& request) {
            bone::RemeshResult result;
            in_strategy += processor_time_of([&] { result = ask("local", request); });
            return result;
        });
        bone::RemeshRequest request;
        request.base = bone;
        request.solids = {&blade};
        const auto all = cut_across(0.0, -13.0_mm, 0.0, 0.1_mm, 3.0_mm);
        for (std::size_t n = 0; n < all.size(); ++n) {
            in_strategy = 0.0;
            const double time = processor_time_of([&] { saw.cut(all[n]); });
            if (n < 50) continue;  // in the air
            local.push_back(time);
            asked.push_back(in_strategy);
        }
        request.cuts = {{blade_at(0.0, -13.0_mm), blade_at(0.0, -8.0_mm), 0}};
        if (bone::RemeshResult begun = ask("whole_rounded", request); begun.status == KERF_OK)
            request.base = std::move(begun.mesh);
        const std::size_t count = size > 50e3 ? 15 : 40;
        for (std::size_t n = 50; n < 50 + count; ++n) {
            request.cuts = {all[n]};
            bone::RemeshResult result;
            whole.push_back(processor_time_of([&] { result = ask("whole_rounded", request); }));
            if (result.status == KERF_OK) request.base = std::move(result.mesh);
        }
        const double ours = times_of(local).median, theirs = times_of(whole).median;
        std::printf("%10zu  %8.1f %8.1f  %8.1f  %8.1f %8.1f  %6.1f  %d\n", bone.tags.size(), 1e-3 * ours,
                    1e-3 * quantile_of(local, 0.99), 1e-3 * times_of(asked).median, 1e-3 * theirs,
                    1e-3 * quantile_of(whole, 0.99), theirs / ours, saw.refusals());
    }
}

void cut() {
    const ToolSolid blade = slot_blade();
    const bone::TaggedMesh bone = bone::tagged(bent_bone(80e3));
    bone::RemeshRequest request;
    request.base = bone;
    request.solids = {&blade};
    request.cuts = {{blade_at(0.0, -13.0_mm), blade_at(0.0, 13.0_mm), 0}};
    bone::RemeshResult exact;
    const double exact_time = processor_time_of([&] { exact = ask("exact", request); });
    const double volume = bone::signed_volume_of(bone.mesh) - bone::signed_volume_of(exact.mesh.mesh);
    std::printf("\none slot through %zu triangles\n%-24s %10s %12s %10s\n", bone.tags.size(), "", "ms", "removed, mm3",
                "error");
    std::printf("%-24s %10.0f %12.4f\n", "exact, at once", 1e-3 * exact_time, 1e9 * volume);
    for (const double feed : {2.0_mm, 0.5_mm, 0.1_mm}) {
        bone::LocalCutting saw(bone, {&blade}, 20e-6, [](const bone::RemeshRequest& r) { return ask("local", r); });
        const double time = processor_time_of([&] {
            for (const bone::CutStretch& step : cut_across(0.0, -13.0_mm, 13.0_mm, feed, 0.0)) saw.cut(step);
        });
        std::printf("local, steps of %3.1f mm    %10.0f %12.4f %9.4f %%  %s\n", 1e3 * feed, 1e-3 * time,
                    1e9 * saw.removed(), 100.0 * (saw.removed() / volume - 1.0), flaw_of(bone, saw).c_str());
    }
}

void long_run() {
    const ToolSolid blade = slot_blade();
    const bone::TaggedMesh bone = bone::tagged(bent_bone(80e3));
    bone::LocalCutting saw(bone, {&blade}, 20e-6, [](const bone::RemeshRequest& r) { return ask("local", r); });
    std::vector<double> times;
    for (const double x : {-15.0_mm, -5.0_mm, 5.0_mm, 15.0_mm})
        for (const bone::CutStretch& step : cut_across(x, -12.5_mm, 12.5_mm, 0.05_mm, 3.0_mm))
            times.push_back(processor_time_of([&] { saw.cut(step); }));
    const std::size_t tenth = times.size() / 10;
    const double first = times_of({times.begin(), times.begin() + static_cast<std::ptrdiff_t>(tenth)}).median,
                 last = times_of({times.end() - static_cast<std::ptrdiff_t>(tenth), times.end()}).median;
    const std::string flaw = flaw_of(bone, saw);
    const bone::SurfaceMesh mesh = saw.surface().mesh().mesh;
    std::printf(
        "\n%zu steps of 0.05 mm in four slots: first tenth %.1f ms, last %.1f ms, median of all %.1f ms, p99 %.1f ms\n"
        "%zu faces, then %zu; %u pieces; %d refused; %s\n",
        times.size(), 1e-3 * first, 1e-3 * last, 1e-3 * times_of(times).median, 1e-3 * quantile_of(times, 0.99),
        bone.tags.size(), mesh.triangles.size(), bone::pieces_of(mesh, bone::half_edges_of(mesh)).count, saw.refusals(),
        flaw.empty() ? "closed, no crossings" : flaw.c_str());
}

void coplanar(int count) {
    const ToolSolid blade = slot_blade();
    const bone::TaggedMesh bone = bone::tagged(bent_bone(5e3));
    std::mt19937 random(11);
    std::uniform_int_distribution<std::size_t> any_face(0, bone.mesh.triangles.size() - 1);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int passed[3] = {}, tried[3] = {};
    for (int n = 0; n < count; ++n) {
        const int kind = n % 3;
        const bone::Triangle& face = bone.mesh.triangles[any_face(random)];
        const auto [a, b, c] = bone.mesh.corners(face);
        Pose pose = blade_at(a.x, 0.0);
        if (kind == 1) {  // the blade's side in the plane of a face
            const Vec3 out = normalized(cross(b - a, c - a));
            pose.rotation = quat_between(rotate(pose.rotation, {0, 1, 0}), out) * pose.rotation;
        }
        const Vec3 normal = rotate(pose.rotation, {0, 1, 0}), way = rotate(pose.rotation, {0, 0, 1});
        pose.position = pose.position + dot(a - pose.position, normal) * normal - 0.2_mm * normal;
        const double from = dot(a - pose.position, way) - 3.0_mm, deep = 4.0_mm + 2.0_mm * any(random);
        const auto at = [&](double depth) { return Pose{pose.position + depth * way, pose.rotation}; };
        bone::LocalCutting saw(bone, {&blade}, 20e-6, [](const bone::RemeshRequest& r) { return ask("local", r); });
        saw.cut({at(from), at(from + deep), 0});
        if (kind == 2) {  // again along the old cut, deeper
            saw.cut({at(from), at(from + deep), 0});
            saw.cut({at(from), at(from + deep + 1.0_mm), 0});
        }
        const std::string flaw = flaw_of(bone, saw);
        ++tried[kind];
        passed[kind] += flaw.empty();
        if (!flaw.empty()) std::printf("  case %d: %s\n", n, flaw.c_str());
    }
    std::printf("\n%-32s %4d of %d\n%-32s %4d of %d\n%-32s %4d of %d\n", "walls through vertices", passed[0], tried[0],
                "sides in the plane of a face", passed[1], tried[1], "along an old cut", passed[2], tried[2]);
}

void print_groove(const char* name, const chart::Groove& groove, const chart::GrooveSurface& made) {
    std::printf("%-30s %9.4f %8.3f %% %8.1f %8.1f %8.2f %8zu %7.1f %7.1f  %s\n", name, 1e9 * made.removed,
                100.0 * (made.removed / groove.volume - 1.0), 1e6 * made.rms, 1e6 * made.farthest, made.step_ms,
                made.walls, made.few_angle / 1.0_deg, made.mid_angle / 1.0_deg, made.flaw.c_str());
}

void displaced() {
    const chart::Groove groove = chart::groove_within(1.0_mm);
    const chart::Clock clock = [](const auto& work) { return processor_time_of(work); };
    const auto strategy = [](const char* name) {
        return [name](const bone::RemeshRequest& r) { return ask(name, r); };
    };
    std::printf("\na groove 12 mm long, 1 mm deep, by a ball burr of 4 mm; by hand %.4f mm3\n", 1e9 * groove.volume);
    std::printf("%-30s %9s %10s %8s %8s %8s %8s %7s %7s\n", "", "mm3", "error", "rms, um", "max, um", "ms/step",
                "walls", "5 %", "median");
    for (const double feed : {0.5_mm, 0.1_mm}) {
        std::printf("steps of %.1f mm\n", 1e3 * feed);
        const auto run = [&](const char* name, const char* id, double tolerance) {
            print_groove(name, groove, chart::surface_by_steps(groove, strategy(id), {}, tolerance, feed, clock));
        };
        run("displace, 80 um", "displace", 80e-6);
        run("displace, 20 um", "displace", 20e-6);
        run("displace, 5 um", "displace", 5e-6);
        run("local, 20 um", "local", 20e-6);
    }
    std::printf("all at once\n");
    print_groove("exact, polygons to 1 um", groove, chart::surface_at_once(groove, strategy("exact"), clock));
    for (const double voxel : {0.5_mm, 0.25_mm}) {
        char name[64];
        std::snprintf(name, sizeof name, "field, voxels of %4.2f mm", 1e3 * voxel);
        print_groove(name, groove, chart::surface_by_field(groove, voxel, 0.1_mm, clock));
    }
}

/// What a picture shows of a mesh, and from where.
struct View {
    Vec3 middle, look;                          ///< the point in the picture's middle; the way it is looked at
    double left, top, width, height;            ///< [mm] of the picture around it
    std::function<bool(Vec3 centre)> is_shown;  ///< of a face
};

/// Faces that look at the viewer, the farthest first, with their edges; bone light, the wall blue.
void draw(const bone::TaggedMesh& mesh, const View& view, const char* file) {
    const Vec3 right = normalized(cross(view.look, {0, 0, 1})), up = cross(right, view.look);
    struct Drawn {
        double away;
        std::size_t face;
    };
    std::vector<Drawn> drawn;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        const auto [a, b, c] = mesh.mesh.corners(mesh.mesh.triangles[f]);
        const Vec3 centre = (a + b + c) / 3.0;
        if (!view.is_shown(centre) || dot(cross(b - a, c - a), view.look) >= 0.0) continue;
        drawn.push_back({dot(centre, view.look), f});
    }
    std::sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) { return a.away > b.away; });
    std::FILE* out = std::fopen(file, "w");
    if (out == nullptr) {
        std::fprintf(stderr, "%s cannot be written\n", file);
        return;
    }
    std::fprintf(out,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"%g %g %g %g\" width=\"%g\" height=\"%g\">\n"
                 "<desc>For training and research; not for diagnosis, planning or deciding treatment</desc>\n"
                 "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"#fff\"/>\n"
                 "<g stroke=\"#333\" stroke-width=\"%g\" stroke-linejoin=\"round\">\n",
                 view.left, view.top, view.width, view.height, 30.0 * view.width, 30.0 * view.height, view.left,
                 view.top, view.width, view.height, view.width / 950.0);
    for (const Drawn& one : drawn) {
        const auto corners = mesh.mesh.corners(mesh.mesh.triangles[one.face]);
        const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
        const double light = 0.55 + 0.45 * std::max(0.0, -dot(normal, view.look));
        const bool is_wall = mesh.tags[one.face] != KERF_FACE_SURFACE;
        const auto shade = [&](double full) { return static_cast<int>(full * light); };
        std::fprintf(out, "<path fill=\"rgb(%d,%d,%d)\" d=\"", shade(is_wall ? 120 : 240), shade(is_wall ? 170 : 228),
                     shade(is_wall ? 230 : 205));
        for (std::size_t i = 0; i < 3; ++i)
            std::fprintf(out, "%c%.3f %.3f", i == 0 ? 'M' : 'L', 1e3 * dot(corners[i] - view.middle, right),
                         -1e3 * dot(corners[i] - view.middle, up));
        std::fprintf(out, "z\"/>\n");
    }
    std::fprintf(out, "</g>\n</svg>\n");
    std::fclose(out);
}

/// One half of a bone that was parted, onto its wall.
void picture(const char* file) {
    const ToolSolid blade = slot_blade();
    const bone::TaggedMesh bone = bone::tagged(bent_bone(20e3));
    bone::LocalCutting saw(bone, {&blade}, 20e-6, [](const bone::RemeshRequest& r) { return ask("local", r); });
    for (const bone::CutStretch& step : cut_across(0.0, -13.0_mm, 13.0_mm, 1.0_mm, 3.0_mm)) saw.cut(step);
    const Vec3 normal_of_slot = rotate(blade_at(0.0, 0.0).rotation, {0, 1, 0}), middle = blade_at(0.0, 2.0_mm).position;
    draw(saw.surface().mesh(),
         {middle, normalized(normal_of_slot + Vec3{0, 0.55, -0.5}), -13, -10, 19, 17,
          [=](Vec3 centre) {
              return dot(centre - middle, normal_of_slot) >= 0.0 && length(centre - middle) <= 16.0_mm;
          }},
         file);
}

/// A groove in a bone, by `displace` in steps of 0.25 mm.
void groove_picture(const char* file) {
    const ToolSolid burr = chart::ball_burr(2.0_mm);
    const bone::TaggedMesh bone = bone::tagged(bent_bone(8e3));
    bone::LocalCutting cut(bone, {&burr}, 80e-6, [](const bone::RemeshRequest& r) { return ask("displace", r); });
    const auto at = [](int n) {
        const double angle = 1.0 + 0.02 * n;
        const Vec3 out{0, std::cos(angle), std::sin(angle)};
        return Pose{Vec3{-4.0_mm + 0.2_mm * n, 0, 0} + 8.0_mm * out, quat_between({0, 0, 1}, -out)};
    };
    for (int n = 0; n < 40; ++n) cut.cut({at(n), at(n + 1), 0});
    const Vec3 middle = at(20).position;
    draw(cut.surface().mesh(),
         {middle, normalized(Vec3{0.15, -0.35, -1.0}), -9, -7.5, 18, 15,
          [=](Vec3 centre) { return length(centre - middle) <= 12.0_mm; }},
         file);
}

}  // namespace

int main(int argc, char** argv) {
    if (const std::string error = strategies.open({"kerf_remesh_cgal", "kerf_burring"}); !error.empty()) {
        std::fprintf(stderr, "%s\n", error.c_str());
        return 2;
    }
    std::printf("%s\n\n", strategies.find("local")->remesher->kernel);
    const std::string what = argc > 1 ? argv[1] : "";
    if (what.empty() || what == "steps") steps();
    if (what.empty() || what == "cut") cut();
    if (what.empty() || what == "long") long_run();
    if (what.empty() || what == "displace") displaced();
    if (what == "picture" && argc > 2) picture(argv[2]);
    if (what == "groove" && argc > 2) groove_picture(argv[2]);
    if (what.empty() || what == "coplanar") coplanar(argc > 2 ? std::atoi(argv[2]) : 200);
}
