// SPDX-License-Identifier: Apache-2.0
// What the worker's thread costs the loop: the same sawing twice in turns, once with a worker that gets all records,
// looks for pieces and makes the surface, once with none.
//
//     in a row       ticks follow each other at once, and the worker gets the records of four more saws beside: it is
//     busy as long as it
//                    has a processor to itself; what share of the time it was is printed
//     on the clock   a thousand a second, and the worker gets what this saw cuts
//     processor      time on the processor, of the loop's thread; wall: by the clock, with all that the machine does
//     besides all            over the ticks of all rounds; alike: over the ticks of one, each taken as the median of
//     its like in all rounds, so
//                    that what the machine does besides drops out, unless it comes at the same tick every time
//     ratio          with / without
//
// At the end the same on the clock, but with a thread that cuts a mesh of 200 000 triangles by the strategy `local` in
// the turns that count as with it, one patch after the other without a pause.
#include <time.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bone/remesh/local_cutting.h"
#include "bone/remesh/remesh_child.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "core/haptics/scene/surface_worker.h"
#include "studies/times.h"
#include "tests/support/drilled_block.h"
#include "tests/support/saw_rig.h"
#include "tests/support/sawn_tube.h"

namespace {

using namespace kerf;
using namespace literals;

constexpr double spacing = 0.2_mm, feed = 1.0_mm_per_s, approach = 3.0_mm_per_s;
constexpr int ticks = 8000, turn = 1000;
constexpr auto period = std::chrono::milliseconds(1);

double seconds_of(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Forty teeth on their way through a shelled block, the worker beside them if there is one.
struct Sawing {
    const Body& body;
    ToolSetup setup = test::saw({{"tooth_count", 40.0}, {"tooth_pitch", 0.6_mm}, {"run_up", 200.0_ms}});
    HapticLoop haptic{body, setup, test::outline(setup), test::gains(), test::at_depth(-1.0_mm)};
    std::unique_ptr<SurfaceWorker> worker{};
    bool has_neighbours = false;  ///< of whose cuts only the worker knows
    double hand = -1.0_mm;
    std::vector<double> processor{}, wall{};

    [[nodiscard]] double depth() const { return -haptic.world_from_tool().position.z; }
    void tick(double rate, bool is_measured) {
        hand += rate * Simulation::dt;
        double on_processor = 0.0;
        const double by_clock = time_of([&] { on_processor = processor_time_of([&] { loop(); }); });
        if (is_measured) {
            processor.push_back(on_processor);
            wall.push_back(by_clock);
        }
        haptic.make_room();
        if (has_neighbours) push_neighbours();
    }
    /// What a loop does in a tick.
    void loop() {
        haptic.tick({test::at_depth(hand)});
        if (worker == nullptr) return;
        (void)worker->exchange(haptic);
    }
    void push_neighbours() {
        for (const CutRecord& own : haptic.closed())
            for (const double aside : {-3.0_mm, -1.5_mm, 1.5_mm, 3.0_mm}) {
                CutRecord record = own;
                record.from.position.y += aside;
                record.to.position.y += aside;
                if (record.removes) (void)worker->push(record);
            }
    }
};

/// A turn of ticks, in a row or on the clock.
void saw_on(Sawing& sawing, bool is_on_the_clock) {
    auto next = std::chrono::steady_clock::now();
    for (int i = 0; i < turn; ++i) {
        if (is_on_the_clock) std::this_thread::sleep_until(next += period);
        sawing.tick(feed, true);
    }
}

/// What a tick took in each round.
struct Series {
    std::vector<std::vector<double>> rounds;

    [[nodiscard]] std::vector<double> all() const {
        std::vector<double> joined;
        for (const auto& round : rounds) joined.insert(joined.end(), round.begin(), round.end());
        return joined;
    }
    [[nodiscard]] std::vector<double> alike() const {
        std::vector<double> medians;
        for (std::size_t tick = 0; tick < rounds.front().size(); ++tick) {
            std::vector<double> times;
            for (const auto& round : rounds) times.push_back(round[tick]);
            medians.push_back(times_of(times).median);
        }
        return medians;
    }
};
struct Felt {
    Series processor, wall;
    void add(const Sawing& sawing) {
        processor.rounds.push_back(sawing.processor);
        wall.rounds.push_back(sawing.wall);
    }
};

void print(const char* what, const std::vector<double>& with, const std::vector<double>& without) {
    const Times w = times_of(with), o = times_of(without);
    std::printf("  %-18s %8.2f %8.2f  %8.2f %8.2f   %7.3f %7.3f\n", what, w.median, o.median, w.p999, o.p999,
                w.median / o.median, w.p999 / o.p999);
}

void measure(const Body& body, bool is_on_the_clock, int rounds) {
    Felt felt_with, felt_without;
    double worked = 0.0, passed = 0.0;
    bool is_same = true;
    for (int round = 0; round < rounds; ++round) {
        Sawing with{body}, without{body};
        with.worker = std::make_unique<SurfaceWorker>(
            body, std::vector<const ToolSolid*>{&with.haptic.outline().cutting}, SurfaceWorker::Options{.crumb = 1e-9});
        for (Sawing* one : {&with, &without}) {
            while (one->depth() < 5.0_mm) one->tick(approach, false);
            for (int i = 0; i < 1000; ++i) one->tick(feed, false);  // until nothing of the approach waits any more
        }
        with.worker->wait_for_all();
        with.has_neighbours = !is_on_the_clock;
        for (int done = 0; done < ticks; done += turn) {
            saw_on(without, is_on_the_clock);
            const double begun = seconds_of(CLOCK_MONOTONIC), all = seconds_of(CLOCK_PROCESS_CPUTIME_ID),
                         own = seconds_of(CLOCK_THREAD_CPUTIME_ID);
            saw_on(with, is_on_the_clock);
            passed += seconds_of(CLOCK_MONOTONIC) - begun;
            worked += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - all - (seconds_of(CLOCK_THREAD_CPUTIME_ID) - own);
            with.worker->wait_for_all();
        }
        is_same = is_same && with.worker->lost() == 0 &&
                  with.haptic.world_from_tool().position == without.haptic.world_from_tool().position;
        felt_with.add(with);
        felt_without.add(without);
    }
    std::printf("%s: %d rounds of %d ticks each; the worker is busy for %.0f %% of the time; the tools end %s\n",
                is_on_the_clock ? "on the clock" : "in a row", rounds, ticks, 100.0 * worked / passed,
                is_same ? "at the same place" : "APART");
    print("processor, all", felt_with.processor.all(), felt_without.processor.all());
    print("processor, alike", felt_with.processor.alike(), felt_without.processor.alike());
    print("wall, all", felt_with.wall.all(), felt_without.wall.all());
    print("wall, alike", felt_with.wall.alike(), felt_without.wall.alike());
    std::fflush(stdout);
}

/// A thread that asks a strategy for one patch after the other while it may.
class Cutter {
public:
    explicit Cutter(bone::RemeshChild& child) : child_(&child), thread_([this] { cut(); }) {}
    ~Cutter() {
        is_over_ = true;
        thread_.join();
    }
    Cutter(const Cutter&) = delete;
    Cutter& operator=(const Cutter&) = delete;

    std::atomic<bool> may_cut{false};
    std::atomic<std::size_t> patches{0};

private:
    void cut() {
        const ToolSolid blade = test::slot_blade();
        const bone::TaggedMesh bone = bone::tagged(test::bent_bone(200'000.0));
        bone::LocalCutting saw(bone, {&blade}, 20e-6, [this](const bone::RemeshRequest& request) {
            ++patches;
            return child_->remesh(request, std::chrono::seconds(20));
        });
        const auto uncut = saw.moment();
        while (!is_over_) {
            saw.restore(uncut);
            for (const bone::CutStretch& step : test::cut_across(0.0, -13.0_mm, 13.0_mm, 0.1_mm, 3.0_mm)) {
                while (!may_cut && !is_over_) std::this_thread::sleep_for(std::chrono::microseconds(200));
                if (is_over_) return;
                saw.cut(step);
            }
        }
    }

    bone::RemeshChild* child_;
    std::atomic<bool> is_over_{false};
    std::thread thread_;
};

void measure_beside_cuts(const Body& body, int rounds) {
    std::string error;
    const auto child = bone::RemeshChild::start(
        {KERF_BUILD_DIR "/libexec/kerf/kerf-remesh", KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so", "local"}, error);
    if (child == nullptr) {
        std::printf("%s\n", error.c_str());
        return;
    }
    Cutter cutter(*child);
    Felt felt_with, felt_without;
    for (int round = 0; round < rounds; ++round) {
        Sawing with{body}, without{body};
        for (Sawing* one : {&with, &without}) {
            while (one->depth() < 5.0_mm) one->tick(approach, false);
            for (int i = 0; i < 1000; ++i) one->tick(feed, false);
        }
        for (int done = 0; done < ticks; done += turn) {
            saw_on(without, true);
            cutter.may_cut = true;
            saw_on(with, true);
            cutter.may_cut = false;
        }
        felt_with.add(with);
        felt_without.add(without);
    }
    std::printf("beside `local`, on the clock: %d rounds of %d ticks each, %zu patches\n", rounds, ticks,
                cutter.patches.load());
    print("processor, all", felt_with.processor.all(), felt_without.processor.all());
    print("processor, alike", felt_with.processor.alike(), felt_without.processor.alike());
    print("wall, all", felt_with.wall.all(), felt_without.wall.all());
    print("wall, alike", felt_with.wall.alike(), felt_without.wall.alike());
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 3;
    const Body body = test::shelled_block({-17.0_mm, -4.0_mm, -20.0_mm}, {17.0_mm, 4.0_mm, 0}, 2.0_mm, spacing);
    std::printf("a saw of 40 teeth at 1 mm/s, spacing 0.2 mm, kernel %s (bar: p99.9 on the processor at most 1.10)\n",
                block_kernel().name);
    std::printf("[us]                      median              p99.9            ratio\n");
    std::printf("                        with  without      with  without    median   p99.9\n");
    measure(body, false, 3 * rounds);
    measure(body, true, rounds);
    measure_beside_cuts(body, rounds);
    return 0;
}
