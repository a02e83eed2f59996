// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>

#include "core/haptics/simulation.h"
#include "kerf/force.hpp"

/// A blunt probe with the smallest law there is: its tip touches. It can be told to go wrong.
namespace kerf::test {

struct Touch {
    struct State {
        std::uint64_t steps = 0;  ///< commits so far
    };
    enum : std::size_t {
        stiffness,
        fault_from,
        fault_until,
        tool_parameter_count = 0,
        force_parameter_count = 3,
        drive_count = 0,
        signal_count = 0
    };

    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept {
        const Vec3 tip{};
        kerf_surface_point at;
        bone.nearest({&tip, 1}, {&at, 1});
        if (at.body < 0) return;
        kerf_channel* c = channels.add(KERF_CONTACT, 1);
        c->d[0] = -at.normal.x;
        c->d[1] = -at.normal.y;
        c->d[2] = -at.normal.z;
        c->k = tick.force[stiffness];
        c->delta = -at.distance;
        const auto now = static_cast<double>(state.steps);
        if (now >= tick.force[fault_from] && now < tick.force[fault_until])
            c->k = std::numeric_limits<double>::quiet_NaN();
    }
    static void commit(const Tick&, const BoneQuery&, const Advance&, State& state, std::span<double>,
                       Actions&) noexcept {
        ++state.steps;
    }
};

inline ToolSetup probe(double k, double fault_from = 1e18, double fault_until = 1e18) {
    static constexpr kerf_tool tool{
        sizeof(kerf_tool), nullptr, 0, [](const double*, kerf_tool_shape* out) -> kerf_status {
            const kerf_profile_point points[] = {{0.0, 0.0}, {-0.5e-3, 0.5e-3}, {-50e-3, 0.5e-3}};
            std::copy(std::begin(points), std::end(points), out->profile);
            out->profile_count = 3;
            out->cutting_count = 2;
            out->grip_z = -60e-3;
            return KERF_OK;
        }};
    using Table = ForceTable<Touch>;
    static constexpr kerf_force force{
        sizeof(kerf_force), sizeof(Touch::State), alignof(Touch::State), nullptr, 0, nullptr, 0, 5000,
        &Table::begin,      &Table::resist,       &Table::commit};
    static constexpr kerf_component components[] = {
        {sizeof(kerf_component), KERF_KIND_TOOL, "probe", "", nullptr, 0, 0, &tool, nullptr, nullptr},
        {sizeof(kerf_component), KERF_KIND_FORCE, "touch", "", nullptr, 0, 0, nullptr, &force, nullptr}};
    return {&components[0], &components[1], {}, {k, fault_from, fault_until}, {}};
}

}  // namespace kerf::test
