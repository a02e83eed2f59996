// SPDX-License-Identifier: Apache-2.0
// The surface of a bone, on one thread.
//
//     whole    a thick tube with a head and ripples in 256³ samples: one welded mesh with normals, beside VTK's
//              FlyingEdges3D (float, with normals) and OpenVDB's volumeToMesh (quads, no normals) of the same samples,
//              by turns, in one run
//     frames   what a tool changes in a thirtieth of a second at 0.2 mm: the bricks it touched, meshed anew, and the
//              table of all bricks that readers get, made anew. table, list: that table alone, and a copy of one
//              pointer for every brick
//     ratio    median of the others / median of ours
//
// Times on the processor, so that what else the machine does is not counted.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#ifdef KERF_HAS_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>
#endif
#ifdef KERF_HAS_VTK
#include "bench/flying_edges.h"
#endif

#include "core/field/surface/bone_surface.h"
#include "core/field/surface/patch_table.h"
#include "core/field/surface/surface_patches.h"
#include "studies/times.h"
#include "tests/support/block.h"
#include "tests/support/with_kernel.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double spacing = 0.2_mm;
constexpr int bricks = 32;

/// Distance to the bone, to a few per cent.
double bone(Vec3 p) {
    const double around = std::atan2(p.y, p.x);
    const double ripple = 0.3_mm * std::sin(9.0 * around) * std::sin(p.z / 1.7_mm);
    const double r = std::hypot(p.x, p.y);
    const double tube = std::max({r - 19.0_mm + ripple, 13.5_mm + 0.7 * ripple - r, std::abs(p.z) - 21.5_mm});
    const double head = length(p - Vec3{9.0_mm, 4.0_mm, 8.0_mm}) - 9.0_mm + ripple;
    return std::min(tube, head) / 1.2;
}

Body bone_of(bool has_shell) {
    const double edge = bricks * brick_edge * spacing;
    const Grid grid{
        .bricks = {bricks, bricks, bricks}, .spacing = spacing, .origin = {-0.5 * edge, -0.5 * edge, -0.5 * edge}};
    Body body;
    body.surface = LevelSet::build(grid, bone);
    if (has_shell)
        body.materials.push_back({"cortical", 1850.0, LevelSet::build(grid, [](Vec3 p) { return -bone(p) - 1.0_mm; })});
    body.materials.push_back({"cancellous", 250.0, {}});
    return body;
}

void print(const char* who, const std::vector<double>& times, std::size_t triangles, double ours) {
    const Times t = times_of(times);
    std::printf("  %-34s %8.2f %8.2f   %8.1f", who, 1e-3 * t.median, 1e-3 * t.longest,
                1e3 * t.median / static_cast<double>(triangles));
    if (ours > 0.0) std::printf("   %5.1f", t.median / ours);
    std::printf("\n");
}

#ifdef KERF_HAS_VTK
FlyingEdges flying_edges_of(const Body& body) {
    const Grid& g = body.grid();
    std::vector<float> dense;
    dense.reserve(g.brick_count() * brick_edge * brick_edge * brick_edge);
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i)
                dense.push_back(static_cast<float>(g.quantum() * body.surface.sample(i, j, k)));
    return FlyingEdges({g.samples(0), g.samples(1), g.samples(2)}, g.spacing, {g.origin.x, g.origin.y, g.origin.z},
                       dense);
}
#endif

#ifdef KERF_HAS_OPENVDB
openvdb::FloatGrid::Ptr sparse_grid_of(const Body& body) {
    const Grid& g = body.grid();
    openvdb::initialize();
    openvdb::FloatGrid::Ptr sparse = openvdb::FloatGrid::create(static_cast<float>(g.clamp()));
    auto accessor = sparse->getAccessor();
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i) {
                const std::int16_t v = body.surface.sample(i, j, k);
                const auto metres = static_cast<float>(g.quantum() * v);
                if (v == -32767)
                    accessor.setValueOff({i, j, k}, metres);
                else if (v != 32767)
                    accessor.setValue({i, j, k}, metres);
            }
    sparse->setTransform(openvdb::math::Transform::createLinearTransform(g.spacing));
    sparse->setGridClass(openvdb::GRID_LEVEL_SET);
    sparse->pruneGrid();
    return sparse;
}
#endif

void whole(int rounds) {
    const Body body = bone_of(false), shelled = bone_of(true);
    const CutField cut(body, 1), shelled_cut(shelled, 1);
    const Grid& g = body.grid();
    const std::size_t triangles = bone_surface(body, cut).triangles.size();
    std::printf("whole: %d x %d x %d samples, %zu triangles\n", g.samples(0), g.samples(1), g.samples(2), triangles);

#ifdef KERF_HAS_VTK
    const FlyingEdges flying = flying_edges_of(body);
    std::vector<double> vtk;
    std::size_t vtk_triangles = 0;
#endif
#ifdef KERF_HAS_OPENVDB
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const openvdb::FloatGrid::Ptr sparse = sparse_grid_of(body);
    std::vector<double> openvdb;
#endif

    std::vector<double> ours, portable, with_tissues, patches, welded;
    std::size_t sum = 0;
    for (int round = 0; round < rounds; ++round) {
        ours.push_back(processor_time_of([&] { sum += bone_surface(body, cut).triangles.size(); }));
#ifdef KERF_HAS_VTK
        vtk.push_back(processor_time_of([&] { vtk_triangles = flying.mesh(); }));
#endif
#ifdef KERF_HAS_OPENVDB
        openvdb.push_back(processor_time_of([&] {
            std::vector<openvdb::Vec3s> points;
            std::vector<openvdb::Vec4I> quads;
            openvdb::tools::volumeToMesh(*sparse, points, quads);
            sum += quads.size();
        }));
#endif
        with_tissues.push_back(processor_time_of([&] { sum += bone_surface(shelled, shelled_cut).triangles.size(); }));
        {
            const test::WithKernel with(portable_kernel());
            portable.push_back(processor_time_of([&] { sum += bone_surface(body, cut).triangles.size(); }));
        }
        SurfacePatches kept(body);
        patches.push_back(processor_time_of([&] { sum += kept.update_all(cut).size(); }));
        welded.push_back(processor_time_of([&] { sum += kept.welded().triangles.size(); }));
    }
    std::printf("  [ms]                                 median      max   ns/triangle   ratio\n");
    const double our_median = times_of(ours).median;
    print("ours, welded, normals", ours, triangles, 0.0);
#ifdef KERF_HAS_VTK
    print("VTK FlyingEdges3D, normals", vtk, vtk_triangles, our_median);
#endif
#ifdef KERF_HAS_OPENVDB
    print("OpenVDB volumeToMesh", openvdb, triangles, our_median);
#endif
    print("the portable kernel", portable, triangles, our_median);
    print("with the tissue of two materials", with_tissues, triangles, our_median);
    print("as patches, kept", patches, triangles, our_median);
    print("patches welded", welded, triangles, our_median);
    if (sum == 1) std::printf("\n");
}

/// Records as the cut log closes them, a twentieth of a voxel apart, and a frame each thirtieth of a second.
void frames(const char* what, const Body& body, const ToolSolid& tool, Pose from, Vec3 direction, double speed,
            int count) {
    CutField cut(body, 4096);
    SurfacePatches surface(body);
    const auto at = [&](double way) { return Pose{from.position + way * direction, from.rotation}; };
    CutRecord record;
    record.from = record.to = from;
    cut.stamp(record, tool);
    PatchTable table = PatchTable(body.grid().brick_count()).with(surface.update_all(cut));
    cut.take_changed();
    double way = 0.0;
    std::vector<double> times, dirty, published, triangles, tables, lists;
    const std::vector<std::shared_ptr<const BrickPatch>> list = [&] {
        std::vector<std::shared_ptr<const BrickPatch>> all;
        for (std::size_t b = 0; b < body.grid().brick_count(); ++b) all.push_back(surface.patch(b));
        return all;
    }();
    for (int frame = 1; frame <= count; ++frame) {
        while (way + 0.05 * spacing <= frame * speed / 30.0) {
            record.from = at(way);
            record.to = at(way += 0.05 * spacing);
            cut.stamp(record, tool);
        }
        std::size_t bricks_changed = 0;
        std::vector<SurfacePatches::Published> news;
        times.push_back(processor_time_of([&] {
            const std::vector<std::size_t> changed = cut.take_changed();
            bricks_changed = changed.size();
            news = surface.update(cut, changed);
            tables.push_back(processor_time_of([&] { table = table.with(news); }));
        }));
        lists.push_back(processor_time_of([&] { auto copy = list; }));
        dirty.push_back(static_cast<double>(bricks_changed));
        published.push_back(static_cast<double>(news.size()));
        double made = 0.0;
        for (const auto& n : news) made += n.patch == nullptr ? 0.0 : static_cast<double>(n.patch->triangles().size());
        triangles.push_back(made);
    }
    const Times t = times_of(times), d = times_of(dirty), p = times_of(published), n = times_of(triangles);
    std::printf("  %-22s %3.0f %9.3f %8.3f %8.3f   %5.0f %5.0f   %5.0f %5.0f   %7.0f   %6.3f %6.3f\n", what,
                1e3 * speed, 1e-3 * t.median, 1e-3 * t.p999, 1e-3 * t.longest, d.median, d.longest, p.median, p.longest,
                n.median, 1e-3 * times_of(tables).median, 1e-3 * times_of(lists).median);
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 25;
#ifndef KERF_HAS_VTK
    std::printf("VTK is not installed (libvtk9-dev): it is left out\n");
#endif
#ifndef KERF_HAS_OPENVDB
    std::printf("OpenVDB is not installed (libopenvdb-dev, libboost-dev, libimath-dev): it is left out\n");
#endif
    whole(rounds);

    std::printf("frames: a thirtieth of a second at %.1f mm\n", spacing / 1.0_mm);
    std::printf("                       mm/s  median    p99.9      max   bricks dirty   published   triangles   table  "
                " list\n                          "
                "   [ms]                         median   max  median   max    median     [ms]   [ms]\n");
    const Body body = bone_of(true);
    const ToolSolid drill = test::drill_outline(1.6_mm, 59.0_deg, 30.0_mm);
    const ToolSolid disc({{0.3_mm, 10.0_mm}, {-0.3_mm, 10.0_mm}});
    // The oscillating saw's default: 18 teeth 1.4 mm apart on an arc of 60 mm, swinging by 5°.
    const double half_sweep = 0.5 * 18.0 * 1.4 / 60.0 + 2.5_deg;
    const ToolSolid blade = test::blade_outline(60.0_mm, 60.0_mm * std::sin(half_sweep), 1.0_mm, 1.0_mm);
    const Vec3 across = normalized(Vec3{0.02, -1, 0.03});
    for (const double speed : {1.0e-3, 3.0e-3}) {
        const int count = static_cast<int>(5.0_mm / speed * 30.0);
        frames("drill, 3.2 mm", body, drill, test::pointing({20.0_mm, 0.3_mm, -9.0_mm}, {-1, 0.05, 0.1}),
               normalized(Vec3{-1, 0.05, 0.1}), speed, count);
        frames("disc, 20 x 0.6 mm", body, disc, test::pointing({28.0_mm, 0.3_mm, -9.0_mm}, {0.1, 0.05, -1}),
               normalized(Vec3{-1, 0, -0.1}), speed, count);
        frames("saw blade, 30 x 1 mm", body, blade, test::pointing({0.3_mm, 19.0_mm, -9.0_mm}, across), across, speed,
               count);
    }
    return 0;
}
