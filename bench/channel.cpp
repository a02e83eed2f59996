// SPDX-License-Identifier: Apache-2.0
// One distance field asked at many points: a level set in bricks, beside the same samples in an OpenVDB grid asked
// through GridSampler with BoxSampler and an accessor. Both warm, by turns, in one run; ours checks its bounds at every
// point. What the clock takes is taken off.
//
//     lips     500 points on the lips of a 5.4 mm drill that moves 1 µm a round
//     random   500 points anywhere in the narrow band
//     element  500 points on the lips as edges ask: cut, gap, tissues, density
//     ratio    median time of OpenVDB / median time of ours
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#ifdef KERF_HAS_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#endif

#include "studies/times.h"
#include "tests/support/drilled_block.h"
#include "tests/support/with_kernel.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr std::size_t count = 500;
constexpr int rounds = 4000;
double sink = 0.0;
const NetTime cost_of([](const auto& work) { return time_of(work); });

struct Ours {
    const LevelSet& field;
    const std::vector<Vec3>& points;
    Vec3 by{};

    void ask() const {
        LocatedBlock places;
        BlockValues distance;
        const GridFrame grid(field.grid(), {}, frame_of({by, {1, 0, 0, 0}}));
        for (std::size_t first = 0; first < points.size(); first += block_capacity) {
            grid.locate(points.data() + first, std::min(block_capacity, points.size() - first), places);
            field.at(places, distance);
            sink += distance[7];
        }
    }
};

void print(const char* what, const char* who, const std::vector<double>& times, double against) {
    const Times t = times_of(times);
    std::printf("  %-8s %-9s %8.2f %8.2f %8.2f %8.2f   %6.2f", what, who, t.mean, t.median, t.p999, t.longest,
                1e3 * t.median / count);
    if (against > 0.0) std::printf("   %6.1f", against / t.median);
    std::printf("\n");
}

#ifdef KERF_HAS_OPENVDB
openvdb::FloatGrid::Ptr copy_of(const LevelSet& field) {
    const Grid& g = field.grid();
    auto copy = openvdb::FloatGrid::create(static_cast<float>(g.clamp()));
    auto accessor = copy->getAccessor();
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i) {
                const std::int16_t v = field.sample(i, j, k);
                if (v != 32767) accessor.setValue({i, j, k}, static_cast<float>(g.quantum() * v));
            }
    auto index = openvdb::math::Transform::createLinearTransform(g.spacing);
    index->postTranslate({g.origin.x, g.origin.y, g.origin.z});
    copy->setTransform(index);
    copy->pruneGrid();
    return copy;
}
#endif

void compare(const char* what, const LevelSet& field, const std::vector<Vec3>& points) {
    std::vector<double> ours, portable, theirs;
    Ours mine{field, points};
#ifdef KERF_HAS_OPENVDB
    const auto grid = copy_of(field);
    const auto accessor = grid->getConstAccessor();
    const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler> sampler(
        accessor, grid->transform());
    double largest = 0.0;
    for (const Vec3 p : points)
        largest = std::max(largest, std::abs(sampler.wsSample({p.x, p.y, p.z}) - field.at(locate(field.grid(), p))));
    std::printf("  %-8s both agree to %.2g mm\n", what, largest / 1.0_mm);
#endif
    for (int round = 0; round < rounds; ++round) {
        mine.by = {0, 0, -1e-6 * (round % 100)};
        ours.push_back(cost_of([&] { mine.ask(); }));
        {
            const test::WithKernel with(portable_kernel());
            portable.push_back(cost_of([&] { mine.ask(); }));
        }
#ifdef KERF_HAS_OPENVDB
        theirs.push_back(cost_of([&] {
            for (const Vec3 p : points) sink += sampler.wsSample({p.x, p.y, p.z + mine.by.z});
        }));
#endif
    }
    const double against = theirs.empty() ? 0.0 : times_of(theirs).median;
    print(what, block_kernel().name, ours, against);
    print(what, "portable", portable, against);
    if (!theirs.empty()) print(what, "OpenVDB", theirs, 0.0);
}

}  // namespace

int main() {
    constexpr double radius = 2.7_mm, slope = 0.6008606;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
#ifndef KERF_HAS_OPENVDB
    std::printf("OpenVDB is not installed (libopenvdb-dev, libboost-dev, libimath-dev): only our own times\n");
#endif
    std::printf("  [us]                   mean   median    p99.9      max  ns/point   ratio\n");
    for (const double h : {0.5_mm, 0.2_mm}) {
        std::printf("spacing %.1f mm\n", h / 1.0_mm);
        // A hole as the drill leaves it: the lips are within its border.
        const Vec3 low{-8.0_mm, -8.0_mm, -22.0_mm}, high{8.0_mm, 8.0_mm, 0};
        const ToolSolid tool = test::drill_outline(radius, 59.0_deg, 20.0_mm);
        const Pose tool_from_body = inverse(test::pointing({0, 0, -14.0_mm}, {0, 0, -1}));
        const Grid grid = test::shelled_block(low, high, 1.0_mm, h).grid();
        const LevelSet hole = LevelSet::build(grid, [&](Vec3 p) {
            return std::max(test::box_distance(p, low, high), -tool.distance(tool_from_body * p));
        });
        std::vector<Vec3> lips, anywhere;
        for (std::size_t n = 0; n < count; ++n) {
            const double r = radius * (static_cast<double>(n / 2) + 0.5) / 250.0;
            lips.push_back({n % 2 == 0 ? r : -r, 0.02_mm, -14.0_mm + slope * r});
        }
        while (anywhere.size() < count) {
            const Vec3 p{8.0_mm * unit(random), 8.0_mm * unit(random), -11.0_mm + 11.0_mm * unit(random)};
            if (std::abs(hole.at(locate(grid, p))) < grid.clamp()) anywhere.push_back(p);
        }
        compare("lips", hole, lips);
        compare("random", hole, anywhere);

        test::DrilledBlock drilled(h);
        drilled.move(8.0_mm, 0.0, 8000, true);
        std::vector<Vec3> edges;
        for (std::size_t n = 0; n < count; ++n) {
            const double r = 1.6_mm * (static_cast<double>(n / 2) + 0.5) / 250.0;
            edges.push_back({n % 2 == 0 ? r : -r, 0.0, -slope * r});
        }
        std::vector<kerf_bone_sample> samples(count);
        std::vector<double> times;
        for (int round = 0; round < rounds; ++round)
            times.push_back(cost_of([&] {
                drilled.view.sample(edges.data(), count, {0, 0, 1}, samples.data());
                sink += samples[7].engagement;
            }));
        print("element", block_kernel().name, times, 0.0);
    }
    return sink == 0.125 ? 1 : 0;  // so that no answer is left out
}
