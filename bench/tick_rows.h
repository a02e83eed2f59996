// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <vector>

#include "core/haptics/scene/simulation.h"
#include "studies/times.h"

/// What ticks cost, and how it is printed.
namespace kerf::bench {

inline constexpr const char* times_header = "[us]            mean    median     p99.9       max";

/// Prints the name of a row and its times, without the end of the line. Returns the times.
inline Times print_times(const char* name, const std::vector<double>& microseconds) {
    const Times t = times_of(microseconds);
    std::printf("  %-9s %9.2f %9.2f %9.2f %9.2f", name, t.mean, t.median, t.p999, t.longest);
    return t;
}
inline void print_row(const char* name, const std::vector<double>& microseconds) {
    print_times(name, microseconds);
    std::printf("\n");
}

/// Costs of ticks on the thread that calls [µs]: the loop, the second field that the worker stamps, both.
struct TickCosts {
    std::vector<double> loop, no_lag, both;

    /// Runs a tick and adds what it costs.
    template <class CostOf>
    TickResult tick(Simulation& simulation, const DeviceSample& sample, const CostOf& cost_of) {
        TickResult result;
        loop.push_back(cost_of([&] { result = simulation.loop().tick(sample); }));
        no_lag.push_back(cost_of([&] { simulation.follow(); }));
        both.push_back(loop.back() + no_lag.back());
        return result;
    }
    void add(const TickCosts& more) {
        loop.insert(loop.end(), more.loop.begin(), more.loop.end());
        no_lag.insert(no_lag.end(), more.no_lag.begin(), more.no_lag.end());
        both.insert(both.end(), more.both.begin(), more.both.end());
    }
    void print() const {
        print_row("loop", loop);
        print_row("no lag", no_lag);
        print_row("both", both);
    }
};

}  // namespace kerf::bench
