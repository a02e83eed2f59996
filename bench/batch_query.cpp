// SPDX-License-Identifier: Apache-2.0
// The batch kernel against the same questions one by one, in one run: a drill in its hole, a voxel of pending records.
//
//     ratio = median time of the scalar reference / median time of BoneView
//
// "edges" are 60 points on the lips, "shank" 64 points with normals on rings behind the corner, "tip" the same
// rings on the cone, where every pending record matters.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "studies/times.h"
#include "tests/support/drilled_block.h"
#include "tests/support/scalar_bone_query.h"

namespace {

using namespace kerf;

double sink = 0.0;

template <class Ask>
double time_of_asking(const Ask& ask) {
    return time_of([&] { sink += ask(); });
}

void report(const char* scene, const char* what, std::size_t points, const std::vector<double>& scalar,
            const std::vector<double>& batch) {
    const Times one = times_of(scalar), all = times_of(batch);
    std::printf("%-9s %-6s %3zu   %8.2f %8.2f   %8.2f %8.2f   %6.1f\n", scene, what, points, one.median, one.p999,
                all.median, all.p999, one.median / all.median);
}

void measure(const char* scene, const test::DrilledBlock& hole) {
    constexpr int rounds = 4000;
    constexpr double radius = 1.6e-3, slope = 0.6009;  // of the cone: cot 59°
    std::vector<Vec3> edges, shank, tip;
    for (int i = 0; i < 60; ++i) {
        const double r = radius * (i / 2 + 0.5) / 30.0;
        edges.push_back({i % 2 == 0 ? r : -r, 0.0, -slope * r});
    }
    for (int level = 0; level < 8; ++level)
        for (int i = 0; i < 8; ++i) {
            const double angle = 0.7853981633974483 * i, on_cone = radius * (level + 0.5) / 8.0;
            shank.push_back({1.55e-3 * std::cos(angle), 1.55e-3 * std::sin(angle), -3.5e-3 - 0.4e-3 * level});
            tip.push_back({on_cone * std::cos(angle), on_cone * std::sin(angle), -slope * on_cone});
        }
    const test::ScalarBoneQuery scalar{hole.body, hole.committed, hole.tracker, hole.at};
    kerf_bone_sample samples[64];
    kerf_surface_point surface[64];
    std::vector<double> one, all;
    const auto compare = [&](const char* what, std::size_t points, const auto& ask_one, const auto& ask_all) {
        one.clear();
        all.clear();
        for (int round = 0; round < rounds; ++round) {
            one.push_back(time_of_asking(ask_one));
            all.push_back(time_of_asking(ask_all));
        }
        report(scene, what, points, one, all);
    };
    const auto count = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
    compare(
        "edges", edges.size(),
        [&] {
            double sum = 0.0;
            for (const Vec3 p : edges) sum += scalar.sample(p, {0, 0, 1}).engagement;
            return sum;
        },
        [&] {
            hole.view.sample(edges.data(), count(edges), {0, 0, 1}, samples);
            return samples[7].engagement;
        });
    for (const auto& [what, points] : {std::pair{"shank", &shank}, std::pair{"tip", &tip}})
        compare(
            what, points->size(),
            [&] {
                double sum = 0.0;
                for (const Vec3 p : *points) sum += scalar.nearest(p).distance;
                return sum;
            },
            [&] {
                hole.view.nearest(points->data(), count(*points), surface);
                return surface[7].distance;
            });
}

}  // namespace

int main() {
    std::printf("                      scalar [us]         batch [us]\n");
    std::printf("scene     what  points   median    p99.9     median    p99.9    ratio\n");
    for (const double h : {0.5e-3, 0.25e-3}) {
        std::printf("spacing %.2f mm\n", h * 1e3);
        test::DrilledBlock hole(h);
        hole.move(8e-3, 0.0, 8000, true);
        measure("cutting", hole);
        hole.move(7.8e-3, 0.01, 200, false);
        measure("back", hole);
    }
    return sink == 0.125 ? 1 : 0;  // so that no answer is left out
}
