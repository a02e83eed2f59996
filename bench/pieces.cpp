// SPDX-License-Identifier: Apache-2.0
// Finding that bone came apart, while a saw goes through a tube of 256³ samples, two voxels a frame, beside looking at
// the whole volume each frame. One run, time on the processor.
//
//     finder      what changed is told to the finder record by record, 8 records a frame; all of a frame together, the
//     list of
//                 changed bricks included
//     at once     the same frame told to another finder in one go
//     run-length  runs along x joined by union-find, over a dense volume of bytes that is kept up to date for nothing
//     flood       voxel by voxel over the same
//     ratio       median of run-length / median of the row; slowest: median of run-length / longest of the row
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "core/field/pieces/piece_finder.h"
#include "studies/times.h"
#include "tests/support/whole_volume.h"

namespace {

using namespace kerf;

constexpr double h = 0.2e-3, frame_feed = 2.0 * h;
constexpr int samples = 256, records_per_frame = 8;

void print(const char* what, const std::vector<double>& times, double against) {
    const Times t = times_of(times);
    std::printf("  %-10s %10.1f %10.1f %10.1f %10.1f", what, t.mean, t.median, t.p999, t.longest);
    if (against > 0.0) std::printf(" %8.0f %8.0f", against / t.median, against / t.longest);
    std::printf("\n");
}

}  // namespace

int main() {
    // A tube along x of 47 mm, its wall 8 mm thick and rippled, so that no row is like the next.
    const Grid grid{{samples / 8, samples / 8, samples / 8}, h, {-128 * h, -128 * h, -128 * h}};
    Body body;
    body.surface = LevelSet::build(grid, [](Vec3 p) {
        const double r = std::hypot(p.y, p.z), ripple = 0.2e-3 * std::sin(2e3 * p.x) * std::cos(1.7e3 * p.y);
        return 0.8 * std::max({r - 23.5e-3 - ripple, 15.5e-3 - r, std::abs(p.x) - 24.0e-3});
    });
    body.materials.push_back({"cortical", 1850.0, {}});
    CutField cut(body, 4096);
    PieceFinder finder(body, cut), at_once(body, cut);
    test::SolidVolume volume = test::solid_volume(body, cut);
    std::printf("For training and research; not for diagnosis, planning or deciding treatment.\n");
    std::printf("%zu of %zu samples are bone\n", finder.samples(), volume.solid.size());

    // A blade 1 mm thick, across the tube.
    const ToolSolid blade({{0.5e-3, 40e-3}, {-0.5e-3, 40e-3}});
    const auto at = [](double rim) { return Pose{{3.03e-3, 0, rim + 40e-3}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}}; };
    std::vector<double> finder_times, at_once_times, run_times, flood_times;
    std::size_t loose = 0, dirty_bricks = 0;
    int frames = 0;
    bool has_agreed = true;
    for (double rim = 24e-3; rim > -24.5e-3; rim -= frame_feed, ++frames) {
        std::vector<std::size_t> all_changed;
        double spent = 0.0;
        for (int n = 0; n < records_per_frame; ++n) {
            CutRecord record;
            record.from = at(rim - frame_feed * n / records_per_frame);
            record.to = at(rim - frame_feed * (n + 1) / records_per_frame);
            cut.stamp(record, blade);
            std::vector<std::size_t> changed;
            spent += processor_time_of([&] {
                changed = cut.take_changed();
                loose += finder.update(cut, changed).size();
            });
            all_changed.insert(all_changed.end(), changed.begin(), changed.end());
        }
        finder_times.push_back(spent);
        std::sort(all_changed.begin(), all_changed.end());
        all_changed.erase(std::unique(all_changed.begin(), all_changed.end()), all_changed.end());
        dirty_bricks += all_changed.size();
        at_once_times.push_back(processor_time_of([&] { (void)at_once.update(cut, all_changed); }));
        if (frames % 8 == 0) {
            volume = test::solid_volume(body, cut);
            std::vector<std::size_t> by_runs, by_flood;
            run_times.push_back(processor_time_of([&] { by_runs = test::pieces_by_runs(volume); }));
            flood_times.push_back(processor_time_of([&] { (void)test::flooded(volume, &by_flood); }));
            has_agreed = has_agreed && by_runs.size() == loose + 1 && by_flood.size() == loose + 1;
        }
    }
    const double against = times_of(run_times).median;
    std::printf("%d frames, %.0f changed bricks each; %zu came off; %llu of %d records asked the whole graph; the "
                "plain ways %s\n",
                frames, static_cast<double>(dirty_bricks) / frames, loose,
                static_cast<unsigned long long>(finder.whole_searches()), frames * records_per_frame,
                has_agreed ? "agree" : "DO NOT AGREE");
    std::printf("  [us]             mean     median      p99.9    longest    ratio  slowest\n");
    print("finder", finder_times, against);
    print("at once", at_once_times, against);
    print("run-length", run_times, 0.0);
    print("flood", flood_times, 0.0);
    return has_agreed ? 0 : 1;
}
