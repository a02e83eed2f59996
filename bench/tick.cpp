// SPDX-License-Identifier: Apache-2.0
// What a tick costs: a 5.4 mm drill fed by hand at 1 mm/s, 14 mm deep in a shelled block, next to two plain methods, in
// one run and in turns of 100 ticks. Time on the processor, without what reading it costs, which the first line prints.
//
//     loop        all of a tick with the points that the law itself samples: as many laws as it needs, contact with
//                 normals, the solve, commit, committed cut
//     + points    the loop, and as many more points as make 500 edges with their gap and 2000 contact points with
//     normals no lag      the second field, which the worker stamps: not part of the loop all         loop, points and
//     no lag papers      500 edges and 2000 contact points, nearest voxel; then every voxel of the tool's bounding box
//                 (plain_papers.h)
//     dense       the same points in a dense grid of distances, raised to the tool's depth (dense_field.h)
//     ratio       mean of papers / mean of the row, mean of dense / mean of the row; (medians)
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "bench/dense_field.h"
#include "bench/plain_papers.h"
#include "bench/tick_rows.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "studies/times.h"
#include "tests/support/drill_rig.h"
#include "tests/support/drilled_block.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double diameter = 5.4_mm, radius = 0.5 * diameter, point_depth = 0.6008606 * radius;  // 118°
constexpr double depth = 14.0_mm, approach = 8.0_mm_per_s, feed = 1.0_mm_per_s;
constexpr int ticks = 4000, turn = 100;  // measured over 4 mm about the depth
constexpr int settling = 1000;           // at the same feed before, until nothing of the approach waits any more
const Vec3 low{-8.0_mm, -8.0_mm, -22.0_mm}, high{8.0_mm, 8.0_mm, 0};

double sink = 0.0;

const NetTime cost_of([](const auto& work) { return processor_time_of(work); });

/// How many points a law asks about.
struct Count {
    std::size_t edges = 0, contact = 0;
};
Count points_of_law(Simulation& simulation, const ToolSetup& setup) {
    static const kerf_bone_query* bone;
    static Count count;
    bone = &simulation.bone().query();
    count = {};
    kerf_bone_query counting = *bone;
    counting.sample = [](const kerf_bone* of, const kerf_vec3* p, std::uint32_t n, const kerf_vec3* d,
                         std::uint32_t directions, kerf_bone_sample* out) {
        count.edges += n;
        bone->sample(of, p, n, d, directions, out);
    };
    counting.nearest = [](const kerf_bone* of, const kerf_vec3* p, std::uint32_t n, kerf_surface_point* out) {
        count.contact += n;
        bone->nearest(of, p, n, out);
    };
    const kerf_tick_in in = tick_in_of(setup, counting, Simulation::dt);
    kerf_channel channels[KERF_MAX_CHANNELS]{};
    kerf_law law{};
    law.size = sizeof law;
    law.channel = channels;
    setup.force->force->resist(&in, simulation.state(), &law);
    return count;
}

/// The papers' points, asked of our bone, but for as many as the law asks about itself.
struct ManyPoints {
    std::vector<Vec3> edges, contact;
    std::vector<kerf_bone_sample> samples;
    std::vector<kerf_surface_point> surface;

    explicit ManyPoints(const Count& own) : own_(own) {
        for (std::size_t n = 0; n < bench::PlainPapers::elements; ++n) {
            const double r = radius * (static_cast<double>(n / 2) + 0.5) / 250.0;
            edges.push_back({n % 2 == 0 ? r : -r, 0.0, -r * point_depth / radius});
        }
        for (std::size_t n = 0; n < bench::PlainPapers::contact_points; ++n) {
            const double angle = 2.0 * pi * static_cast<double>(n % 40) / 40.0;
            const double along = (static_cast<double>(n / 40) + 0.5) / 50.0;
            contact.push_back({(radius - 0.05_mm) * std::cos(angle), (radius - 0.05_mm) * std::sin(angle),
                               -point_depth - along * (depth - point_depth)});
        }
        samples.resize(edges.size());  // also for all of them, which kernels are compared with
        surface.resize(contact.size());
    }
    [[nodiscard]] std::size_t edge_count() const { return edges.size() - std::min(edges.size(), own_.edges); }
    [[nodiscard]] std::size_t contact_count() const { return contact.size() - std::min(contact.size(), own_.contact); }
    void ask_edges(const BodiesView& bone, std::size_t count) {
        bone.sample(edges.data(), static_cast<std::uint32_t>(count), {0, 0, 1}, samples.data());
        sink += samples[7].engagement;
    }
    void ask_contact(const BodiesView& bone) {
        bone.nearest(contact.data(), static_cast<std::uint32_t>(contact_count()), surface.data());
        sink += surface[7].distance;
    }
    /// Those asked last with a border within `reach` [m].
    [[nodiscard]] std::size_t near(double reach) const {
        std::size_t count = 0;
        for (std::size_t n = 0; n < contact_count(); ++n)
            count += surface[n].body >= 0 && std::abs(surface[n].distance) <= reach;
        return count;
    }

private:
    Count own_;
};

struct Baselines {
    Times papers, dense;
};
void print(const char* what, const std::vector<double>& microseconds, const Baselines* baselines = nullptr) {
    const Times t = bench::print_times(what, microseconds);
    if (baselines != nullptr)
        for (const Times& b : {baselines->papers, baselines->dense})
            std::printf("   %7.1f (%.1f)", b.mean / t.mean, b.median / t.median);
    std::printf("\n");
}

/// One law of both kernels by turns, in the hole as it is.
void compare_kernels(const BodiesView& bone, ManyPoints& points) {
    const BlockKernel& before = block_kernel();
    if (avx2_kernel() == nullptr) {
        std::printf("  this machine has no AVX2\n");
        return;
    }
    std::printf("  portable / AVX2, medians:");
    for (const std::size_t count : {60u, 500u}) {
        std::vector<double> plain, fast;
        for (int round = 0; round < 4000; ++round)
            for (auto* times : {&plain, &fast}) {
                use_block_kernel(times == &plain ? portable_kernel() : *avx2_kernel());
                times->push_back(time_of([&] { points.ask_edges(bone, count); }));
            }
        const double a = times_of(plain).median, b = times_of(fast).median;
        std::printf("  %zu edge points %.2f / %.2f us = %.2f", count, a, b, a / b);
    }
    std::printf("\n");
    use_block_kernel(before);
}

/// The drill, and a hand that moves it down.
struct FedDrill {
    ToolSetup setup = test::twist_drill({{"diameter", diameter}});
    Simulation simulation;
    double hand = -1.0_mm;  ///< [m] depth of the hand

    explicit FedDrill(const Body& body)
        : simulation(body, setup, test::outline(setup), test::gains(), test::at_depth(-1.0_mm)) {}
    /// Moves the hand by a tick at `rate` [m/s].
    void move(double rate) { hand += rate * Simulation::dt; }
    [[nodiscard]] double at() const { return -simulation.world_from_tool().position.z; }  ///< [m] depth of the tip
    void drill(double rate) {
        move(rate);
        sink += simulation.tick({test::at_depth(hand)}).thrust;
    }
    /// Drills to where measuring begins. Returns whether the drill gets there.
    bool approach_depth() {
        while (at() < depth - (0.5 * ticks + settling) * feed * Simulation::dt) {
            drill(approach);
            if (hand > depth + 6.0_mm) return false;
        }
        for (int n = 0; n < settling; ++n) drill(feed);
        return true;
    }
};

/// Costs of each tick [µs]; bricks that it stamped.
struct Costs {
    std::vector<double> loop, no_lag, with_points, all, papers, dense, bricks;
    std::vector<double> papers_force, papers_removal;
};

/// Measures `turn` ticks of the loop, then the baselines at the same poses.
void measure_turn(FedDrill& fed, ManyPoints& points, bench::PlainPapers& plain, bench::DenseField& field,
                  Costs& costs) {
    Simulation& simulation = fed.simulation;
    std::vector<Pose> poses;
    for (int n = 0; n < turn; ++n) {
        fed.move(feed);
        const DeviceSample sample{test::at_depth(fed.hand)};
        const double in_loop = cost_of([&] { sink += simulation.loop().tick(sample).thrust; });
        const double by_worker = cost_of([&] { simulation.follow(); });
        const double more = cost_of([&] {
            points.ask_edges(simulation.bone(), points.edge_count());
            points.ask_contact(simulation.bone());
        });
        costs.loop.push_back(in_loop);
        costs.no_lag.push_back(by_worker);
        costs.bricks.push_back(simulation.tracker().last_bricks());
        costs.with_points.push_back(in_loop + more);
        costs.all.push_back(in_loop + by_worker + more);
        poses.push_back(simulation.world_from_tool());
    }
    for (const Pose& pose : poses) {
        const double force = cost_of([&] {
            const Vec6 cut = plain.cutting(pose, feed * 0.03), touch = plain.contact(pose);
            sink += cut[2] + touch[0];
        });
        const double removal = cost_of([&] { sink += static_cast<double>(plain.remove(pose)); });
        costs.papers_force.push_back(force);
        costs.papers_removal.push_back(removal);
        costs.papers.push_back(force + removal);
        costs.dense.push_back(cost_of([&] {
            sink += field.cutting(pose, points.edges) + field.contact(pose, points.contact).x;
            field.remove(pose);
        }));
    }
}

void print(const Costs& costs) {
    const Baselines baselines{times_of(costs.papers), times_of(costs.dense)};
    print("loop", costs.loop, &baselines);
    print("+ points", costs.with_points, &baselines);
    print("no lag", costs.no_lag);
    print("all", costs.all, &baselines);
    print("papers", costs.papers);
    print(" points", costs.papers_force);
    print(" removal", costs.papers_removal);
    print("dense", costs.dense);
    const Times stamped = times_of(costs.bricks);
    std::printf("  bricks that a tick stamped, of %d as a rule: mean %.1f, p99.9 %.0f, most %.0f\n",
                CutTracker::bricks_per_tick, stamped.mean, stamped.p999, stamped.longest);
}

void measure(double h) {
    const Body body = test::shelled_block(low, high, 1.0_mm, h);
    FedDrill fed(body);
    if (!fed.approach_depth()) {
        std::printf("the drill does not come so deep: it stands at %.1f mm\n", fed.at() / 1.0_mm);
        return;
    }
    bench::PlainPapers plain(low, high, h, 300.0, {radius, point_depth, depth + 3.0_mm});
    bench::DenseField field(low, high, h, {radius, point_depth, depth + 3.0_mm});
    for (double z = 0.0; z < fed.at(); z += 0.5 * h) {
        plain.remove(test::at_depth(z));
        field.remove(test::at_depth(z));
    }

    const Count own = points_of_law(fed.simulation, fed.setup);
    ManyPoints points(own);
    const double from = fed.at();
    Costs costs;
    for (int t = 0; t < ticks; t += turn) measure_turn(fed, points, plain, field, costs);
    std::printf("spacing %.1f mm, from %.1f to %.1f mm deep, kernel %s\n", h / 1.0_mm, from / 1.0_mm, fed.at() / 1.0_mm,
                block_kernel().name);
    std::printf("  the law asks about %zu edge and %zu contact points; of %zu other contact points a border is within "
                "a voxel of %zu\n",
                own.edges, own.contact, points.contact_count(), points.near(h));
    print(costs);
    compare_kernels(fed.simulation.bone(), points);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    std::printf("asking for the processor's time takes %.2f us: taken off\n", cost_of.asking());
    std::printf("%s     papers/row       dense/row\n", bench::times_header);
    for (const double h : {0.5_mm, 0.2_mm, 0.1_mm})
        if (argc < 2 || std::abs(std::atof(argv[1]) * 1.0_mm - h) < 1e-6) measure(h);
    return sink == 0.125 ? 1 : 0;  // so that no answer is left out
}
