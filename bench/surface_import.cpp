// SPDX-License-Identifier: Apache-2.0
// A bone out of a surface: the distance fields of one mesh, on one thread.
//
//     tree        one query of the triangle tree a sample: the oracle
//     bricks      the same field a brick at a time; `differing` counts the samples that differ from the tree's
//     border      the border of a shell 4 mm deep, by bricks and by the tree
//     OpenVDB     meshToLevelSet of the same triangles, the same spacing and 4 voxels to either side
//     ratio       median of the others / median of the bricks
//
// Usage: bench_surface_import [MESH] [SPACING_MM] [ROUNDS]. Without a mesh: a bent tube of 28 800 triangles.
// Times on the processor, so that what else the machine does is not counted.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#ifdef KERF_HAS_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>
#endif

#include "bone/import/bone_distances.h"
#include "bone/surface/read_surface.h"
#include "bone/surface/repair.h"
#include "core/field/grid/level_set.h"
#include "kerf/units.hpp"
#include "studies/times.h"

namespace {

using namespace kerf;
using namespace literals;

/// A closed bent tube, 100 mm long and 26 mm thick, with ripples.
bone::SurfaceMesh bent_tube() {
    constexpr std::uint32_t around = 96, along = 150;
    bone::SurfaceMesh mesh;
    for (std::uint32_t j = 0; j <= along; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const double turn = 2.0 * 3.14159265358979 * i / around, way = static_cast<double>(j) / along;
            const double thick = 13.0_mm + 0.6_mm * std::sin(5.0 * turn + 20.0 * way);
            mesh.vertices.push_back(
                {thick * std::cos(turn) + 15.0_mm * way * way, thick * std::sin(turn), 100.0_mm * way});
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * around + i % around; };
    for (std::uint32_t j = 0; j < along; ++j)
        for (std::uint32_t i = 0; i < around; ++i)
            mesh.triangles.insert(mesh.triangles.end(), {bone::Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                         {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    mesh.vertices.push_back({0, 0, 0});
    mesh.vertices.push_back({15.0_mm, 0, 100.0_mm});
    const auto low = static_cast<std::uint32_t>(mesh.vertices.size() - 2);
    for (std::uint32_t i = 0; i < around; ++i)
        mesh.triangles.insert(mesh.triangles.end(),
                              {bone::Triangle{low, at(i + 1, 0), at(i, 0)}, {low + 1, at(i, along), at(i + 1, along)}});
    return mesh;
}

void print(const char* what, const std::vector<double>& times, double ours, long differing) {
    const Times t = times_of(times);
    std::printf("  %-40s %9.0f", what, 1e-3 * t.median);
    if (ours > 0.0) std::printf("   %6.1f", t.median / ours);
    if (differing >= 0) std::printf("   %ld differing", differing);
    std::printf("\n");
}

long differing_samples(const LevelSet& one, const LevelSet& other) {
    long count = 0;
    for (std::size_t b = 0; b < one.grid().brick_count(); ++b) {
        if (one.has_border(b) != other.has_border(b)) count += stored_samples;
        if (!one.has_border(b) || !other.has_border(b)) continue;
        for (int n = 0; n < stored_samples; ++n) count += one.stored(b)[n] != other.stored(b)[n];
    }
    return count;
}

template <class Work>
auto timed(int rounds, std::vector<double>& times, const Work& work) {
    auto result = work();
    for (int round = 0; round < rounds; ++round) {
        times.push_back(processor_time_of([&] { result = work(); }));
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    bone::SurfaceMesh mesh;
    if (argc > 1) {
        text::Diagnostics diagnostics;
        auto file = bone::read_surface(argv[1]).take(diagnostics);
        if (!file) {
            std::fprintf(stderr, "%s", to_text(diagnostics).c_str());
            return 2;
        }
        mesh = std::move(file->mesh);
        for (Vec3& v : mesh.vertices) v = 1e-3 * v;
        if (!file->has_topology) bone::weld(mesh);
    } else {
        mesh = bent_tube();
    }
    const double spacing = (argc > 2 ? std::atof(argv[2]) : 0.5) * 1.0_mm;
    const int rounds = argc > 3 ? std::atoi(argv[3]) : 3;
    const Box box = bounds_of(mesh);
    const Vec3 margin = 6.0 * spacing * Vec3{1, 1, 1};
    const Grid grid = Grid::covering(box.low - margin, box.high + margin, spacing);
    const bone::TriangleTree tree(mesh);
    bone::MeshDistances surface(tree);
    bone::SignedDistance single(tree);
    documents::Tissue cortical;
    cortical.thickness = 4.0_mm;
    bone::TissueBorder border(surface, cortical);

    std::printf("%zu triangles, spacing %.2f mm, %d x %d x %d bricks, medians of %d rounds, one thread\n\n",
                mesh.triangles.size(), 1e3 * spacing, grid.bricks[0], grid.bricks[1], grid.bricks[2], rounds);
    std::printf("  %-40s %9s   %6s\n", "", "ms", "ratio");
    std::vector<double> by_bricks, by_tree, border_by_bricks, border_by_tree;
    const LevelSet fast = timed(rounds, by_bricks, [&] { return LevelSet::build(grid, surface); });
    const LevelSet slow = timed(1, by_tree, [&] { return LevelSet::build(grid, [&](Vec3 p) { return single(p); }); });
    const LevelSet fast_border = timed(rounds, border_by_bricks, [&] { return LevelSet::build(grid, border); });
    const LevelSet slow_border = timed(1, border_by_tree, [&] {
        return LevelSet::build(grid, [&](Vec3 p) { return -single(p) - cortical.thickness; });
    });
    const double ours = times_of(by_bricks).median, our_border = times_of(border_by_bricks).median;
    print("surface, by bricks", by_bricks, 0.0, differing_samples(fast, slow));
    print("surface, by the tree", by_tree, ours, -1);
    print("border 4 mm deep, by bricks", border_by_bricks, 0.0, differing_samples(fast_border, slow_border));
    print("border 4 mm deep, by the tree", border_by_tree, our_border, -1);
#ifdef KERF_HAS_OPENVDB
    openvdb::initialize();
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    for (const Vec3 v : mesh.vertices) points.emplace_back(v.x, v.y, v.z);
    for (const bone::Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    const auto transform = openvdb::math::Transform::createLinearTransform(spacing);
    std::vector<double> by_openvdb;
    const auto peer = timed(rounds, by_openvdb, [&] {
        return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, points, triangles, clamp_voxels);
    });
    print("surface, OpenVDB meshToLevelSet", by_openvdb, ours, -1);
    std::printf("\n  OpenVDB keeps %llu samples, Kerf %zu kB\n",
                static_cast<unsigned long long>(peer->activeVoxelCount()), fast.memory_bytes() / 1024);
#endif
}
